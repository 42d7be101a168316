// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The map with what stands around it: buttons, legend, what the pointer is at; and the hands on it.
import type { AreaDraft } from './area_draft.ts';
import { hasScale } from './cell_picture.ts';
import type { CellLayer, CellPicture } from './cell_picture.ts';
import { shareOf, ticksOf } from './colours.ts';
import { fillIfChanged, h, notice, refill } from './dom.ts';
import { listenToPointers } from './map_pointer.ts';
import { MapView } from './map_view.ts';
import { SWITCHES } from './scene.ts';
import type { Place, Scene, Switch } from './scene.ts';
import { NearestReading } from './nearest_reading.ts';
import type { GasQuestion } from './nearest_reading.ts';
import { cellInWords, cellsInWords } from './hover_words.ts';
import { ofGas, ofPlans } from './gases.ts';
import { ObjectiveLayer } from './objective_layer.ts';
import type { ObjectiveQuestion } from './objective_layer.ts';
import { outlooksOf } from './objective_words.ts';
import { figure, squaresInWords } from './words.ts';

const LAYERS: [CellLayer, string][] = [['mean', 'Gas'], ['uncertainty', 'Uncertainty'],
  ['change', 'Change'], ['objective', 'Objective'], ['none', 'Walls']];
const SWITCH_NAMES: Record<Switch, string> = {
  frontiers: 'frontiers', ways: 'ways of robots', trails: 'trails', claims: 'claimed goals', names: 'names',
  areas: 'keep-out and homes', why: 'candidates of the plan' };
// A click this near, pixels, means the robot.
const NEAR_ROBOT = 14;
const ZOOM_STEP = 1.4;

// What is drawn on the map, and who sees to it.
export type Drawing = {
  draft: AreaDraft;
  changed(): void; // by the pointer
  key(key: string): boolean; // whether it was one of the drawing's
};

export class MapPanel {
  readonly element: HTMLElement;
  readonly banner = h('div', { class: 'banner', role: 'status' });
  readonly map: MapView;
  // Another of the mission's gases is chosen.
  onGas: (gas: string) => void = () => {};
  // What the change of the gas mean from scene.then to now is called.
  private change = { name: 'Change', title: 'Change of the gas mean' };
  private drawing: Drawing | null = null;
  private pointer: [number, number] | null = null; // where it is, pixels
  private pinned: Scene | null = null; // that can be looked at beside this one
  private pinnedView: MapView | null = null; // of it, once it was
  private readonly nearest: NearestReading | null;
  private readonly objective: ObjectiveLayer | null;
  private hasObjective = false;
  private hasChange = true;

  private readonly canvas = h('canvas', { tabindex: 0, role: 'img',
    'aria-label': 'Map of the mission. Drag or use the arrow keys to pan, + and − to zoom.' });
  private readonly pinnedCanvas = h('canvas', { role: 'img', 'aria-label': 'Map of the pinned moment; it moves ' +
    'with the other one.' });
  private readonly captions = { then: h('div', { class: 'caption' }), now: h('div', { class: 'caption' }) };
  private moments = { then: '', now: '' };
  private readonly legend = h('div', { class: 'legend' });
  private readonly readout = h('div', { class: 'readout' });
  private readonly tools = h('div', { class: 'tools', role: 'toolbar', 'aria-label': 'Map' });

  constructor(private readonly scene: Scene, private readonly onRobot: (robot: string) => void,
              private readonly onPlace: (place: Place) => void, nearest: GasQuestion | null = null,
              private readonly question: ObjectiveQuestion | null = null) {
    this.objective = question === null ? null : new ObjectiveLayer(question, () => scene.raster, () => {
      scene.judged = this.objective!.squares;
      this.map.draw();
      this.showLegend();
    });
    this.nearest = nearest === null ? null : new NearestReading(nearest, () => this.tell());
    this.map = new MapView(this.canvas, scene);
    this.element = h('section', { class: 'stage', 'aria-label': 'Map' },
      this.canvas, h('div', { class: 'pinned' }, this.pinnedCanvas, this.captions.then), this.captions.now,
      this.tools, this.banner, this.readout, this.legend);
    this.listen(this.canvas);
    this.listen(this.pinnedCanvas);
    new ResizeObserver(() => this.map.cover({ width: this.legend.offsetLeft + this.legend.offsetWidth,
      height: this.element.clientHeight - this.legend.offsetTop })).observe(this.legend);
    this.showTools();
    this.showLegend();
  }

  // From now on the pointer draws; null: no more.
  draw(drawing: Drawing | null): void {
    this.drawing = drawing;
    this.scene.draft = drawing?.draft ?? null;
    this.map.draw();
  }
  private drawn(): void {
    this.drawing?.changed();
    this.map.draw();
  }

  setCells(layer: CellLayer, log = this.map.picture.log): void {
    if (layer === 'change' && this.scene.then === null) {
      notice(this.hasChange ? 'Pin a moment first: “Pin to compare” below the map.' : 'There is nothing to compare with.', 'bad');
      return;
    }
    if (layer === 'objective' && !this.hasObjective) {
      notice('This mission has no objective: it maps all there is.', 'bad');
      return;
    }
    this.map.setCells(layer, log);
    this.map.beside?.setCells(layer === 'change' || layer === 'objective' ? 'mean' : layer, log);
    this.judgeAgain();
    this.showTools();
    this.showLegend();
  }
  // Whether the mission has an objective, whose layer can be looked at.
  offerObjective(has: boolean): void {
    if (has === this.hasObjective) return;
    this.hasObjective = has;
    this.showTools();
  }
  // Whether there is, or may be, another map to compare with.
  offerChange(has: boolean): void {
    this.hasChange = has;
    this.showTools();
  }
  private judgeAgain(): void {
    this.scene.judged = [];
    this.objective?.show(this.map.picture.layer === 'objective');
  }
  repaint(): void {
    this.setCells(this.map.picture.layer);
  }

  // Which gases there are to choose from, and which one is looked at.
  offerGases(names: string[], looked: string): void {
    const { gases } = this.scene;
    if (names.join() === gases.names.join() && looked === gases.looked) return;
    this.scene.gases = { names, looked };
    this.showTools();
    this.showLegend();
  }

  // From now on the map of `pinned` can be looked at beside this one. Its scene may change: say so, then.
  // Null: none is any more.
  offer(pinned: Scene | null): void {
    if (pinned === null && this.isBeside) this.lookBeside(false);
    if (pinned === null && this.map.picture.layer === 'change') this.setCells('mean');
    this.pinned = pinned;
    this.map.beside?.replaced();
    this.showTools();
  }
  private get isBeside(): boolean {
    return this.map.beside !== null;
  }
  // What stands above the maps while there are two.
  nameMoments(moments: { then?: string; now?: string }): void {
    Object.assign(this.moments, moments);
    this.captions.then.textContent = this.isBeside ? this.moments.then : '';
    this.captions.now.textContent = this.isBeside ? this.moments.now : '';
  }
  lookBeside(on: boolean): void {
    if (this.pinned === null) return notice('Pin a moment first: “Pin to compare” below the map.', 'bad');
    this.element.classList.toggle('two', on);
    this.pinnedView ??= new MapView(this.pinnedCanvas, this.pinned, this.map);
    this.map.beside = on ? this.pinnedView : null;
    this.scene.beside = on ? this.pinned : null;
    this.map.pointed = null;
    this.nameMoments({});
    this.map.beside?.replaced();
    this.setCells(this.map.picture.layer);
  }

  callChange(name: string, title: string): void {
    this.change = { name, title };
    this.showTools();
    this.showLegend();
  }

  showLegend(): void {
    this.map.picture.prepare(); // the ends of the scale
    const pictures = [this.map.picture];
    // Else both are of one scale.
    if (this.map.beside !== null && this.map.beside.picture.layer !== this.map.picture.layer) {
      pictures.unshift(this.map.beside.picture);
    }
    for (const picture of pictures) picture.prepare();
    const judged = new Set(this.scene.judged.map(({ outlook }) => outlook));
    const { raster, status, homes } = this.scene;
    const squares = squaresInWords(raster?.geometry.resolution_m ?? NaN, status?.geometry?.resolutionM ?? NaN);
    const basis = ofPlans(this.scene.gases);
    const key = [squares, basis, homes.length, [...judged], outlooksOf(this.question?.asked()), pictures.map(({ layer, scale }) => [this.titleOf(layer, scale.log), scale, layer])];
    fillIfChanged(this.legend, JSON.stringify(key), () => [
      ...pictures.flatMap((picture) => this.scaleOf(picture)),
      basis === '' ? null : h('div', {}, basis),
      squares === '' ? null : h('div', {}, `The map is large: ${squares} are shown.`),
      h('div', { class: 'marks' },
        h('span', { class: 'mark m-wall' }, 'wall'), h('span', { class: 'mark m-unknown' }, 'unknown'),
        h('span', { class: 'mark gas m-gas' }, 'gas frontier'),
        h('span', { class: 'mark m-occupancy' }, 'map frontier'),
        homes.length === 0 ? null : h('span', { class: 'm-home' }, homes.length === 1 ? 'home' : 'homes'),
        ...outlooksOf(this.question?.asked()).filter(([outlook]) => judged.has(outlook)).map(([outlook, words]) =>
          h('span', { class: `mark m-${outlook}` }, words)))]);
  }

  private titleOf(layer: CellLayer, log: boolean): string {
    return layer === 'uncertainty' ? `Uncertainty${ofGas(this.scene.gases)}, one σ, ppm`
      : layer === 'change' ? `${this.change.title}, ppm`
        : `Gas mean${ofGas(this.scene.gases)}, ppm${log ? ' (logarithmic)' : ''}`;
  }
  private scaleOf(picture: CellPicture): HTMLElement[] {
    const { layer, scale } = picture;
    if (!hasScale(layer)) return [];
    const title = this.titleOf(layer, scale.log);
    return [h('div', {}, title), this.bar(title, picture), h('div', { class: 'ticks' },
      ...ticksOf(scale).map((value) => {
        const tick = h('span', {}, figure(value, 2));
        tick.style.left = `${100 * shareOf(scale, value)}%`;
        return tick;
      }))];
  }
  private bar(title: string, picture: CellPicture): HTMLElement {
    const colours = picture.colours();
    const { scale } = picture;
    const bar = h('canvas', { width: colours.length, height: 1, role: 'img',
                              'aria-label': `${title}: ${scale.min} to ${scale.max}` });
    const image = new ImageData(colours.length, 1);
    colours.forEach((colour, i) => image.data.set([...colour, 255], 4 * i));
    bar.getContext('2d')!.putImageData(image, 0, 0);
    return bar;
  }

  private showTools(): void {
    const { map } = this;
    const open = this.tools.querySelector('details')?.open ?? false;
    refill(this.tools, this.choiceOfGas(),
      ...LAYERS.filter(([layer]) => layer === 'objective' ? this.hasObjective : layer !== 'change' || this.hasChange).map(([layer, name]) =>
        h('button', { 'aria-pressed': String(map.picture.layer === layer), onclick: () => this.setCells(layer) },
          layer === 'change' ? this.change.name : name)),
      h('button', { 'aria-pressed': String(map.picture.log), disabled: map.picture.layer !== 'mean',
        onclick: () => this.setCells('mean', !map.picture.log) }, 'Log'),
      this.pinned === null ? null : h('button', { 'aria-pressed': String(this.isBeside),
        onclick: () => this.lookBeside(!this.isBeside) }, 'Side by side'),
      h('details', { open }, h('summary', {}, 'Layers'), h('div', {}, ...SWITCHES.map((one) => this.switchOf(one)))),
      h('button', { onclick: () => this.fit() }, 'Fit'),
      h('button', { 'aria-label': 'Zoom in', onclick: () => this.zoom(ZOOM_STEP) }, '+'),
      h('button', { 'aria-label': 'Zoom out', onclick: () => this.zoom(1 / ZOOM_STEP) }, '−'),
      h('button', { 'aria-pressed': String(map.follow), onclick: () => this.toggleFollow() }, 'Follow'));
  }

  private choiceOfGas(): HTMLElement | null {
    const { names, looked } = this.scene.gases;
    if (names.length < 2) return null;
    const choice = h('select', { 'aria-label': 'Gas to look at', onchange: () => this.onGas(choice.value) },
      ...names.map((name) => h('option', { value: name, selected: name === (looked || names[0]) }, name)));
    return choice;
  }

  private switchOf(one: Switch): HTMLElement {
    const { map } = this;
    const box = h('input', { type: 'checkbox', checked: map.on.has(one), onchange: () => {
      if (box.checked) map.on.add(one);
      else map.on.delete(one);
      map.draw();
    } });
    return h('label', {}, box, ` ${SWITCH_NAMES[one]}`);
  }

  private fit(): void {
    this.map.follow = false;
    this.map.untouched = true;
    this.map.fit();
    this.showTools();
  }
  private zoom(factor: number, x?: number, y?: number): void {
    this.map.untouched = false;
    this.map.view.zoom(factor, x, y);
    this.map.draw();
  }
  private pan(dx: number, dy: number): void {
    this.map.untouched = false;
    if (this.map.follow) this.toggleFollow();
    this.map.view.pan(dx, dy);
    this.map.draw();
  }
  private toggleFollow(): void {
    this.map.follow = !this.map.follow;
    this.map.untouched = false;
    this.showTools();
    this.map.draw();
  }

  // The pointer is there now, on that map; null: on none.
  private hover(pointer: [number, number] | null, canvas = this.canvas): void {
    this.pointer = pointer;
    const place = pointer === null ? null : this.placeAt(...pointer);
    this.pointAt(canvas === this.canvas ? null : place, canvas === this.canvas ? place : null);
    this.nearest?.move(pointer === null ? null : this.placeAt(...pointer));
    this.tell();
  }
  // At this place on this map, and on the one beside it.
  private pointAt(here: Place | null, beside: Place | null): void {
    const { map } = this;
    if (map.beside === null) {
      if (map.pointed === null) return;
      here = null;
    } else {
      map.beside.pointed = beside;
    }
    map.pointed = here;
    map.draw();
  }
  // The map is of another moment.
  anotherMoment(): void {
    this.hover(this.pointer);
    this.judgeAgain();
  }
  leave(): void {
    this.hover(null);
    this.objective?.show(false);
  }

  private tell(): void {
    if (this.pointer === null) {
      this.readout.textContent = '';
      return;
    }
    const place = this.placeAt(...this.pointer);
    const { raster } = this.scene;
    const parts = [`${place.x_m.toFixed(2)}, ${place.y_m.toFixed(2)} m`, this.isBeside && this.pinned !== null
      ? cellsInWords(this.pinned.raster, raster, place) : cellInWords(raster, place)];
    if (this.nearest !== null && this.nearest.text !== '') parts.push(this.nearest.text);
    this.readout.textContent = parts.join(' · ');
  }

  private listen(canvas: HTMLCanvasElement): void {
    listenToPointers(canvas, {
      draft: () => this.drawing?.draft ?? null,
      drawn: () => this.drawn(),
      placeAt: (x, y) => this.placeAt(x, y),
      scale: () => this.map.view.scale,
      hover: (at) => this.hover(at, canvas),
      pan: (dx, dy) => this.pan(dx, dy),
      zoom: (by, x, y) => this.zoom(by, x, y),
      click: (x, y) => this.click(x, y),
    });
  }

  private placeAt(x: number, y: number): Place {
    const [x_m, y_m] = this.map.view.toPlace(x, y);
    return { x_m, y_m };
  }

  private click(x: number, y: number): void {
    for (const { pose, robot } of this.scene.status?.robots ?? []) {
      if (pose === undefined) continue;
      const [px, py] = this.map.view.toPixel(pose.xM, pose.yM);
      if (Math.hypot(px - x, py - y) < NEAR_ROBOT) return this.onRobot(robot);
    }
    this.onPlace(this.placeAt(x, y));
  }

  // Whether it was a key of the map.
  onKey(key: string, target: HTMLElement): boolean {
    const isOurs = key === 'Escape' || target === this.canvas || target === document.body;
    if (isOurs && this.drawing?.key(key)) return true;
    const pans: Record<string, [number, number]> = {
      ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60] };
    if (key in pans) {
      if (target !== this.canvas && target !== document.body) return false;
      this.pan(...pans[key]);
      return true;
    }
    const actions: Record<string, () => void> = {
      f: () => this.fit(), '+': () => this.zoom(ZOOM_STEP), '=': () => this.zoom(ZOOM_STEP),
      '-': () => this.zoom(1 / ZOOM_STEP), c: () => this.toggleFollow(),
      g: () => this.setCells('mean', !this.map.picture.log),
      1: () => this.setCells('mean'), 2: () => this.setCells('uncertainty'),
      3: () => this.setCells('change'), 4: () => this.setCells('none'),
      5: () => this.setCells('objective'),
      s: () => this.lookBeside(!this.isBeside) };
    if (!(key in actions)) return false;
    actions[key]();
    return true;
  }
}
