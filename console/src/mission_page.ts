// One mission: the map, and beside it robots, reasons, figures and what can be done.
import { PATIENCE, missions, planning, robots as robotCalls, sentence } from './client.ts';
import type { Trouble } from './client.ts';
import type { CellLayer } from './cell_picture.ts';
import { ChartPanel } from './chart_panel.ts';
import { shareOf, ticksOf } from './colours.ts';
import { fill, fillIfChanged, h, notice } from './dom.ts';
import { MapView, SWITCHES } from './map_view.ts';
import type { Scene, Switch } from './map_view.ts';
import { OperatePanel } from './operate_panel.ts';
import { every, stateClass } from './pages.ts';
import { FREE, OCCUPIED, figuresOf } from './raster.ts';
import type { CellRect } from './raster.ts';
import { refreshSession, session } from './session.ts';
import { Watch, fetchMap } from './watch.ts';
import type { LinkState } from './watch.ts';
import type { MapStatus } from './wire/plumescout/v1/map_service_pb.ts';
import type { Mission } from './wire/plumescout/v1/mission_service_pb.ts';
import type { Robot } from './wire/plumescout/v1/robot_service_pb.ts';
import { duration, figure, link, missionState, phase, shortName } from './words.ts';
import { WhyPanel } from './why_panel.ts';

const MAX_TRAIL_POINTS = 4000;
const TRAIL_STEP_M = 0.05;
const TABS = ['Robots', 'Why', 'Charts', 'Operate'] as const;
type Tab = (typeof TABS)[number];
const LAYERS: [CellLayer, string][] = [['mean', 'Gas'], ['uncertainty', 'Uncertainty'],
  ['change', 'Change'], ['none', 'Walls']];
const SWITCH_NAMES: Record<Switch, string> = {
  frontiers: 'frontiers', ways: 'ways of robots', trails: 'trails', claims: 'claimed goals', names: 'names',
  areas: 'keep-out and home', why: 'candidates of the plan' };

export class MissionPage {
  readonly element: HTMLElement;
  readonly head: HTMLElement[];
  private readonly scene: Scene = {
    raster: null, then: null, figures: null, threshold_ppm: 0, status: null, plans: [], why: null, candidate: -1,
    trails: new Map(), keepOut: [], home: undefined, robot: '', asked: null };
  private readonly canvas = h('canvas', { tabindex: 0, role: 'img',
    'aria-label': 'Map of the mission. Drag or use the arrow keys to pan, + and − to zoom.' });
  private readonly map: MapView;
  private readonly why: WhyPanel;
  private readonly charts: ChartPanel;
  private readonly operate: OperatePanel;
  private readonly robotTab = h('div', {}, h('p', { class: 'empty' }, 'Loading …'));
  private readonly legend = h('div', { class: 'legend' });
  private readonly readout = h('div', { class: 'readout' });
  private readonly banner = h('div', { class: 'banner', role: 'status' });
  private readonly statePill = h('span', { class: 'pill' }, '…');
  private readonly linkPill = h('span', { class: 'pill', role: 'status' }, 'connecting');
  private readonly slider = h('input', { type: 'range', min: 0, max: 1, value: 1, 'aria-label': 'Revision to look at' });
  private readonly moment = h('span', { class: 'quiet' }, 'live');
  private readonly speed = h('select', { 'aria-label': 'Speed' },
    ...[1, 5, 10, 30, 60].map((times) => h('option', { value: times, selected: times === 10 }, `${times}×`)));
  private readonly playButton = h('button', { onclick: () => this.togglePlay() }, '▶ Play');
  private readonly pinButton = h('button', { onclick: () => this.pin() }, 'Pin to compare');
  private readonly tools = h('div', { class: 'tools', role: 'toolbar', 'aria-label': 'Map' });
  private readonly tabBar = h('div', { class: 'tabs', role: 'tablist' });
  private readonly tabBox = h('div', { class: 'tab', role: 'tabpanel' });

  private watch: Watch | null = null;
  private past: bigint | null = null; // the revision that is looked at; null: live
  private playing = false;
  private fetching: AbortController | null = null;
  private head_revision = 0n;
  private then_revision = -1n;
  private tab: Tab = 'Robots';
  private mission: Mission | null = null;
  private robots: Robot[] = [];
  private figuresDue = true;
  private readonly stops: (() => void)[] = [];

  constructor(private readonly name: string, revision: bigint | null) {
    this.head = [this.statePill, this.linkPill];
    this.element = h('main', { class: 'mission' },
      h('section', { class: 'stage', 'aria-label': 'Map' }, this.canvas, this.tools, this.banner, this.readout, this.legend),
      h('aside', { class: 'side', 'aria-label': 'Details' }, this.tabBar, this.tabBox),
      h('footer', { class: 'time', 'aria-label': 'Time' }, this.playButton, this.speed, this.slider, this.moment,
        this.pinButton, h('button', { onclick: () => this.goLive() }, 'Live')));
    this.map = new MapView(this.canvas, this.scene);
    this.why = new WhyPanel((candidate) => {
      this.scene.candidate = candidate;
      this.map.draw();
    });
    this.charts = new ChartPanel((robot) => this.map.colourOf(robot));
    this.operate = new OperatePanel(name, () => this.scene.raster, () => this.link());
    this.listen();
    this.showTools();
    this.showTab('Robots');
    this.showLegend();
    fill(this.banner, 'Waiting for the map …');
    if (revision === null || revision === 0n) this.goLive();
    else void this.goTo(revision);
    this.stops.push(every(1000, () => this.poll()));
  }

  leave(): void {
    this.watch?.stop();
    this.fetching?.abort();
    for (const stop of this.stops) stop();
  }

  private link(): string {
    return `${location.origin}/#/${this.name}@${this.past ?? this.head_revision}`;
  }

  // --- Where the map comes from: live, a moment, or a replay.

  private startWatch(replay: { fromRevision: bigint; speed: number } | null): void {
    this.watch?.stop();
    this.watch = new Watch(this.name, {
      replaced: (raster) => {
        this.scene.raster = raster;
        this.figuresDue = true;
        this.refreshFigures();
        this.map.replaced();
        this.showLegend();
      },
      changed: (rects) => this.changed(rects),
      status: (status, revision) => this.onStatus(status, revision),
      link: (state, trouble, again_s) => this.onLink(state, trouble, again_s),
    }, replay);
  }

  private changed(rects: CellRect[]): void {
    this.figuresDue = true;
    this.map.cellsChanged(rects);
  }

  private onStatus(status: MapStatus, revision: bigint): void {
    this.scene.status = status;
    this.scene.threshold_ppm = status.gasThresholdPpm;
    if (this.past === null) {
      this.head_revision = revision;
      this.slider.max = String(revision);
      this.slider.value = String(revision);
      this.moment.textContent = `live, revision ${revision}`;
    } else {
      this.past = revision;
      this.slider.value = String(revision);
      this.moment.textContent = `revision ${revision} of ${this.head_revision}`;
    }
    for (const robot of status.robots) this.extendTrail(robot.robot, robot.pose?.xM, robot.pose?.yM);
    if (this.scene.robot === '' && status.robots.length > 0) this.choose(status.robots[0].robot);
    this.map.draw();
  }

  private extendTrail(robot: string, x_m: number | undefined, y_m: number | undefined): void {
    if (x_m === undefined || y_m === undefined) return;
    let trail = this.scene.trails.get(robot);
    if (trail === undefined) {
      trail = { points: [] };
      this.scene.trails.set(robot, trail);
    }
    const last = trail.points.at(-1);
    if (last !== undefined && Math.hypot(last[0] - x_m, last[1] - y_m) < TRAIL_STEP_M) return;
    trail.points.push([x_m, y_m]);
    if (trail.points.length > MAX_TRAIL_POINTS) trail.points.shift();
  }

  private onLink(state: LinkState, trouble: Trouble | null, again_s: number): void {
    const words: Record<LinkState, [string, string]> = {
      connecting: ['connecting', 'pill warn'],
      live: this.past === null ? ['live', 'pill good'] : ['playing', 'pill warn'],
      waiting: [`connection lost, again in ${figure(again_s)} s`, 'pill bad'],
      hidden: ['asleep while hidden', 'pill'], ended: ['ended', 'pill bad'] };
    [this.linkPill.textContent, this.linkPill.className] = words[state];
    if (state === 'live') return this.showPastBanner();
    if (state === 'waiting' || state === 'ended') {
      fill(this.banner, trouble === null ? 'The stream has ended.' : `${trouble.text} ${trouble.advice}`,
        state === 'waiting' ? h('button', { onclick: () => this.watch?.retry() }, 'Try now')
          : h('a', { href: '#/' }, 'All missions'));
    }
  }

  private showPastBanner(): void {
    if (this.past === null) {
      const empty = this.scene.status !== null && this.scene.raster === null;
      return fill(this.banner, empty ? 'No map yet: no robot has sent a scan.' : null);
    }
    fill(this.banner, this.playing ? 'What was, played' : `As it was at revision ${this.past}`,
      h('button', { onclick: () => this.goLive() }, 'Back to live'));
  }

  private goLive(): void {
    this.fetching?.abort();
    this.past = null;
    this.setPlaying(false);
    this.scene.trails.clear();
    this.startWatch(null);
    this.showPastBanner();
    if (location.hash.includes('@')) history.replaceState(null, '', `#/${this.name}`);
  }

  private async goTo(revision: bigint): Promise<void> {
    this.watch?.stop();
    this.watch = null;
    this.setPlaying(false);
    this.fetching?.abort();
    const mine = this.fetching = new AbortController();
    this.past = revision;
    this.scene.plans = [];
    this.scene.why = null;
    this.scene.trails.clear();
    [this.linkPill.textContent, this.linkPill.className] = ['looking back', 'pill warn'];
    fill(this.banner, `Making the map of revision ${revision} …`);
    try {
      const { raster, status } = await fetchMap(this.name, revision, mine.signal);
      if (mine.signal.aborted) return;
      this.scene.raster = raster;
      this.onStatus(status, revision);
      this.figuresDue = true;
      this.refreshFigures();
      this.map.replaced();
      this.showLegend();
      this.showPastBanner();
      history.replaceState(null, '', `#/${this.name}@${revision}`);
    } catch (error) {
      if (mine.signal.aborted) return;
      fill(this.banner, sentence(error), h('button', { onclick: () => this.goLive() }, 'Back to live'));
    }
  }

  private setPlaying(playing: boolean): void {
    this.playing = playing;
    this.playButton.textContent = playing ? '■ Stop' : '▶ Play';
  }

  private togglePlay(): void {
    if (this.playing) return void this.goTo(this.past ?? this.head_revision);
    this.fetching?.abort();
    const from = this.past !== null && this.past < this.head_revision ? this.past : 0n;
    this.past = from;
    this.scene.plans = [];
    this.scene.why = null;
    this.scene.trails.clear();
    this.setPlaying(true);
    this.startWatch({ fromRevision: from, speed: Number(this.speed.value) });
  }

  private pin(): void {
    if (this.scene.raster === null) return;
    this.scene.then = this.scene.raster.copy();
    this.then_revision = this.past ?? this.head_revision;
    notice(`Revision ${this.then_revision} is pinned: “Change” shows what the gas mean did since.`);
    this.setCells('change');
  }

  // --- What is polled.

  private async poll(): Promise<void> {
    this.refreshFigures();
    try {
      if (session.info === null) await refreshSession();
      const [got, listed, live] = await Promise.all([
        missions.getMission({ name: this.name }, PATIENCE),
        robotCalls.listRobots({ mission: this.name }, PATIENCE),
        planning.listPlans({ mission: this.name, withLatest: true }, PATIENCE)]);
      this.mission = got.mission ?? null;
      this.robots = listed.robots;
      if (this.mission !== null) {
        this.statePill.className = stateClass(this.mission.state);
        this.statePill.textContent = `${missionState(this.mission.state)} · ${phase(this.mission.phase)}`;
        this.scene.keepOut = this.mission.options?.keepOut ?? [];
        this.scene.home = this.mission.options?.home;
        if (this.mission.revision > this.head_revision) this.head_revision = this.mission.revision;
        this.slider.max = String(this.head_revision);
        if (this.past === null) this.slider.value = this.slider.max;
      }
      if (this.past === null) {
        this.scene.plans = live.plans;
        this.scene.why = live.latest.find((plan) => plan.robot === this.scene.robot) ?? null;
        this.sample(live.latest.map((plan) => [plan.robot,
          Number(plan.cpuDuration?.seconds ?? 0) + (plan.cpuDuration?.nanos ?? 0) * 1e-9]));
      }
    } catch {
      return; // the stream's banner says what is the matter
    }
    this.showSide();
    this.map.draw();
  }

  private refreshFigures(): void {
    if (!this.figuresDue || this.scene.raster === null) return;
    this.figuresDue = false;
    this.scene.figures = figuresOf(this.scene.raster, this.scene.status?.gasThresholdPpm ?? 0);
    this.map.figuresChanged();
    this.showLegend();
  }

  private sample(cpu: [string, number][]): void {
    const { figures, status } = this.scene;
    if (figures === null || status === null) return;
    const add = (title: string, unit: string, value: number, line = '') => this.charts.add(title, unit, line, value);
    add('Known area', 'm²', figures.known_m2);
    add('Largest gas mean', 'ppm', figures.max_ppm);
    add(`Plume (above ${figure(status.gasThresholdPpm)} ppm)`, 'm²', figures.plume_m2);
    add('Mean entropy of the gas field', 'nats', figures.mean_entropy_nats);
    add('Readings in the posterior', '', Number(status.gasCounters?.inPosteriorCount ?? 0));
    for (const [robot, cpu_s] of cpu) add('CPU time of the latest plan', 'ms', 1000 * cpu_s, robot);
    for (const robot of this.robots) {
      if (robot.ingestLagS !== undefined) add('Age of the newest sample', 's', robot.ingestLagS, robot.onMap?.robot);
    }
  }

  // --- The side.

  private showTab(tab: Tab): void {
    this.tab = tab;
    fill(this.tabBar, ...TABS.map((one) => h('button', { role: 'tab', 'aria-selected': String(one === tab),
      onclick: () => this.showTab(one) }, one)));
    fill(this.tabBox, { Robots: this.robotTab, Why: this.why.element, Charts: this.charts.element,
                        Operate: this.operate.element }[tab]);
    this.showSide();
  }

  private showSide(): void {
    if (this.tab === 'Robots') this.showRobots();
    if (this.tab === 'Why') this.why.show(this.scene.robot, this.scene.why);
    if (this.tab === 'Charts') this.charts.draw();
    if (this.tab === 'Operate') this.operate.show(this.mission, this.robots);
  }

  private choose(robot: string): void {
    this.scene.robot = robot;
    this.scene.why = null;
    this.scene.candidate = -1;
    this.why.clear();
    this.scene.asked = null;
    this.showSide();
    this.map.draw();
  }

  private showRobots(): void {
    if (this.mission === null) return;
    if (this.robots.length === 0) {
      return fill(this.robotTab, h('p', { class: 'empty' }, 'No robot has registered yet. ',
        'A robot joins with RegisterRobot: see docs/robots.md.'));
    }
    fill(this.robotTab, ...this.robots.map((robot) => {
      const name = robot.onMap?.robot ?? '';
      const facts: [string, string][] = [
        ['link', link(robot.link)], ['last heard', robot.lastHeardAgeS === undefined ? 'never' : `${duration(robot.lastHeardAgeS)} ago`],
        ['log applied', String(robot.onMap?.appliedSequence ?? 0)]];
      if ((robot.onMap?.rejectedObservationCount ?? 0n) > 0n) facts.push(['refused', String(robot.onMap?.rejectedObservationCount)]);
      if (robot.ingestLagS !== undefined) facts.push(['newest sample', `${duration(robot.ingestLagS)} old`]);
      if (robot.batteryShare !== undefined) facts.push(['battery', `${figure(100 * robot.batteryShare)} %`]);
      if (robot.livePlan !== '') {
        facts.push(['plan', shortName(robot.livePlan)], ['on its way', `${figure(robot.progressS)} s, late by ${figure(Math.max(0, robot.latenessS))} s`]);
      } else {
        facts.push(['plan', 'none']);
      }
      return h('div', { class: name === this.scene.robot ? 'robot chosen' : 'robot' },
        h('div', { class: 'row' }, this.swatch(name),
          h('strong', { class: 'spring' }, shortName(name)),
          robot.orderedHome ? h('span', { class: 'pill warn' }, 'sent home') : null,
          robot.onMap?.frameSuspect ? h('span', { class: 'pill bad' }, 'lost') : null,
          robot.onMap?.silent ? h('span', { class: 'pill bad' }, 'silent') : null,
          h('button', { 'aria-pressed': String(name === this.scene.robot), 'aria-label': `Look at ${shortName(name)}`,
                        onclick: () => this.choose(name) }, name === this.scene.robot ? 'looked at' : 'look at')),
        h('dl', { class: 'facts' }, ...facts.flatMap(([key, value]) => [h('dt', {}, key), h('dd', {}, value)])));
    }), this.missionFacts());
  }

  private swatch(robot: string): HTMLElement {
    const swatch = h('span', { class: 'swatch' });
    swatch.style.background = this.map.colourOf(robot);
    return swatch;
  }

  private missionFacts(): HTMLElement {
    const { figures, status } = this.scene;
    const frontiers = status?.frontiers.filter((one) => !one.tooSmall).length ?? 0;
    const pairs: [string, string][] = [
      ['known', `${figure(figures?.known_m2 ?? NaN)} m²`], ['free', `${figure(figures?.free_m2 ?? NaN)} m²`],
      ['largest gas mean', `${figure(figures?.max_ppm ?? NaN)} ppm`],
      ['plume', `${figure(figures?.plume_m2 ?? NaN)} m² above ${figure(status?.gasThresholdPpm ?? NaN)} ppm`],
      ['readings', `${status?.gasCounters?.inPosteriorCount ?? 0n} of ${status?.gasCounters?.readingCount ?? 0n} in the posterior`],
      ['frontiers', String(frontiers)], ['strategy', this.mission?.options?.planning?.strategy ?? '–']];
    return h('section', {}, h('h3', {}, 'Mission'), h('dl', { class: 'facts' },
      ...pairs.flatMap(([key, value]) => [h('dt', {}, key), h('dd', {}, value)])));
  }

  // --- The map.

  private setCells(cells: CellLayer, log = this.map.picture.log): void {
    if (cells === 'change' && this.scene.then === null) {
      notice('Pin a moment first: “Pin to compare” below the map.', 'bad');
      return;
    }
    this.map.setCells(cells, log);
    this.showTools();
    this.showLegend();
  }

  private showTools(): void {
    const { map } = this;
    const open = this.tools.querySelector('details')?.open ?? false;
    fill(this.tools,
      ...LAYERS.map(([cells, name]) => h('button', { 'aria-pressed': String(map.picture.layer === cells),
        onclick: () => this.setCells(cells) }, name)),
      h('button', { 'aria-pressed': String(map.picture.log), disabled: map.picture.layer !== 'mean',
        onclick: () => this.setCells('mean', !map.picture.log) }, 'Log'),
      h('details', { open }, h('summary', {}, 'Layers'), h('div', {}, ...SWITCHES.map((one) => {
        const box = h('input', { type: 'checkbox', checked: map.on.has(one), onchange: () => {
          if (box.checked) map.on.add(one);
          else map.on.delete(one);
          map.draw();
        } });
        return h('label', {}, box, ` ${SWITCH_NAMES[one]}`);
      }))),
      h('button', { onclick: () => this.fit() }, 'Fit'),
      h('button', { 'aria-label': 'Zoom in', onclick: () => this.zoom(1.4) }, '+'),
      h('button', { 'aria-label': 'Zoom out', onclick: () => this.zoom(1 / 1.4) }, '−'),
      h('button', { 'aria-pressed': String(map.follow), onclick: () => this.toggleFollow() }, 'Follow'));
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
  private toggleFollow(): void {
    this.map.follow = !this.map.follow;
    this.map.untouched = false;
    this.showTools();
    this.map.draw();
  }

  private showLegend(): void {
    const { layer: cells, scale } = this.map.picture;
    const title = cells === 'uncertainty' ? 'Uncertainty, one σ, ppm' : cells === 'change'
      ? `Change of the gas mean since revision ${this.then_revision}, ppm`
      : `Gas mean, ppm${this.map.picture.log ? ' (logarithmic)' : ''}`;
    fillIfChanged(this.legend, JSON.stringify([title, scale, cells]), () => {
      const bar = h('canvas', { width: 256, height: 1, role: 'img', 'aria-label': `${title}: ${scale.min} to ${scale.max}` });
      const image = new ImageData(256, 1);
      this.map.picture.colours().forEach((colour, i) => image.data.set([...colour, 255], 4 * i));
      bar.getContext('2d')!.putImageData(image, 0, 0);
      return [
        ...(cells === 'none' ? [] : [h('div', {}, title), bar, h('div', { class: 'ticks' },
          ...ticksOf(scale).map((value) => {
            const tick = h('span', {}, figure(value, 2));
            tick.style.left = `${100 * shareOf(scale, value)}%`;
            return tick;
          }))]),
        h('div', { class: 'marks' }, h('span', { class: 'mark m-wall' }, 'wall'), h('span', { class: 'mark m-unknown' }, 'unknown'),
          h('span', { class: 'mark gas m-gas' }, 'gas frontier'), h('span', { class: 'mark m-occupancy' }, 'map frontier'))];
    });
  }

  private hover(x: number, y: number): void {
    const { raster } = this.scene;
    const [x_m, y_m] = this.map.view.toPlace(x, y);
    const cell = raster?.cellAt(x_m, y_m) ?? -1;
    const parts = [`${x_m.toFixed(2)}, ${y_m.toFixed(2)} m`];
    if (raster === null || cell < 0) {
      parts.push('off the map');
    } else {
      const state = raster.occupancy[cell];
      parts.push(state === OCCUPIED ? 'occupied' : state === FREE ? 'free' : 'unknown');
      if (!Number.isNaN(raster.mean_ppm[cell])) {
        parts.push(`${figure(raster.mean_ppm[cell])} ± ${figure(Math.sqrt(raster.variance_ppm2[cell]))} ppm`);
      }
    }
    this.readout.textContent = parts.join('  ·  ');
  }

  private listen(): void {
    const { canvas } = this;
    const pointers = new Map<number, [number, number]>();
    let moved = 0;
    const place = (event: { clientX: number; clientY: number }): [number, number] => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, place(event));
      moved = 0;
    });
    canvas.addEventListener('pointermove', (event) => {
      const now = place(event);
      this.hover(...now);
      const before = pointers.get(event.pointerId);
      if (before === undefined) return;
      const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
      const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
      moved += Math.hypot(dx, dy);
      if (moved > 4) {
        this.map.untouched = false;
        if (other === undefined) {
          this.map.follow = false;
          this.map.view.pan(dx, dy);
        } else {
          const spread = (p: [number, number]) => Math.hypot(p[0] - other[0], p[1] - other[1]) + 1;
          this.map.view.zoom(spread(now) / spread(before), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
        }
        this.map.draw();
      }
      pointers.set(event.pointerId, now);
    });
    const end = (event: PointerEvent) => {
      if (!pointers.delete(event.pointerId) || event.type === 'pointercancel' || moved > 4) return;
      this.click(...place(event));
    };
    canvas.addEventListener('pointerup', end);
    canvas.addEventListener('pointercancel', end);
    canvas.addEventListener('pointerleave', () => { this.readout.textContent = ''; });
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * 0.0015), ...place(event));
    }, { passive: false });
    this.slider.addEventListener('input', () => { this.moment.textContent = `revision ${this.slider.value}`; });
    this.slider.addEventListener('change', () => {
      if (BigInt(this.slider.value) >= this.head_revision) this.goLive();
      else void this.goTo(BigInt(this.slider.value));
    });
    this.speed.addEventListener('change', () => {
      if (!this.playing) return;
      this.setPlaying(false);
      this.togglePlay();
    });
    const themed = () => this.map.setCells(this.map.picture.layer);
    window.addEventListener('themechange', themed);
    this.stops.push(() => window.removeEventListener('themechange', themed));
  }

  private click(x: number, y: number): void {
    const robots = this.scene.status?.robots ?? [];
    const hit = robots.find((one) => {
      if (one.pose === undefined) return false;
      const [px, py] = this.map.view.toPixel(one.pose.xM, one.pose.yM);
      return Math.hypot(px - x, py - y) < 14;
    });
    if (hit !== undefined) return this.choose(hit.robot);
    const [x_m, y_m] = this.map.view.toPlace(x, y);
    this.scene.asked = { x_m, y_m };
    this.map.draw();
    this.showTab('Why');
    const pose = robots.find((one) => one.robot === this.scene.robot)?.pose;
    void this.why.ask(this.scene.robot, pose, this.scene.asked, this.scene.why);
  }

  // Whether it was a key of ours.
  onKey(key: string, target: HTMLElement): boolean {
    const pan: Record<string, [number, number]> = {
      ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60] };
    if (key in pan) {
      if (target !== this.canvas && target !== document.body) return false;
      this.map.untouched = false;
      this.map.follow = false;
      this.map.view.pan(...pan[key]);
      this.map.draw();
      return true;
    }
    if (key === ' ' && target.closest('button, summary, a') !== null) return false;
    const actions: Record<string, () => void> = {
      f: () => this.fit(), '+': () => this.zoom(1.4), '=': () => this.zoom(1.4), '-': () => this.zoom(1 / 1.4),
      c: () => this.toggleFollow(), g: () => this.setCells('mean', !this.map.picture.log), l: () => this.goLive(),
      ' ': () => this.togglePlay(),
      1: () => this.setCells('mean'), 2: () => this.setCells('uncertainty'), 3: () => this.setCells('change'),
      4: () => this.setCells('none') };
    if (!(key in actions)) return false;
    actions[key]();
    return true;
  }
}
