// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The map on a canvas: cells as a picture of their own, drawn scaled, and what lies on them as lines.
import { CellPicture } from './cell_picture.ts';
import type { CellLayer } from './cell_picture.ts';
import { MapMarks } from './map_marks.ts';
import { MapPen } from './map_pen.ts';
import type { CellRect, Raster } from '@plumescout/client';
import { SWITCHES } from './scene.ts';
import type { Place, Scene, Switch } from './scene.ts';
import { theme } from './theme.ts';
import { View, knownIn } from './view.ts';
import type { Box, Corner } from './view.ts';

// What the buttons above the map take of it, pixels.
const TOOLS_HEIGHT = 40;
const CAPTION_HEIGHT = 28; // of two maps, below them
const ROBOT_HUES = [20, 230, 150, 320, 80, 275, 190, 0];

export class MapView {
  readonly view: View;
  readonly picture: CellPicture;
  // Shows the same part of the plane, and is drawn when this one is; null: there is none.
  beside: MapView | null = null;
  // What the pointer is at on the other map.
  pointed: Place | null = null;
  readonly on = new Set<Switch>(SWITCHES);
  follow = false;

  private readonly context: CanvasRenderingContext2D;
  private readonly pen: MapPen;
  private readonly marks: MapMarks;
  private scheduled = false;
  private fitted = false;
  private readonly robotHues: Map<string, number>;
  revision = -1n; // of what the scene holds

  // `leader`: whose part of the plane this shows, too, and whose colours robots have; null: its own.
  constructor(private readonly canvas: HTMLCanvasElement, private readonly scene: Scene,
              private readonly leader: MapView | null = null) {
    this.view = leader?.view ?? new View();
    this.robotHues = leader?.robotHues ?? new Map<string, number>();
    this.context = canvas.getContext('2d')!;
    this.pen = new MapPen(this.context, this.view);
    this.marks = new MapMarks(this.context, this.view, this.pen, scene, (robot) => this.colourOf(robot));
    this.picture = new CellPicture(() => scene);
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  private resize(): void {
    const ratio = window.devicePixelRatio || 1;
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    this.view.width = clientWidth;
    this.view.height = clientHeight;
    this.refit();
    this.draw();
  }
  // What the legend takes at the lower left.
  private corner: Corner = { width: 0, height: 0 };
  cover(corner: Corner): void {
    if (corner.width === this.corner.width && corner.height === this.corner.height) return;
    this.corner = corner;
    this.refit();
  }
  // Nobody has panned or zoomed yet.
  untouched = true;

  // Of the known part of the map. It is not looked for in cells that did not change.
  box(): Box | null {
    const { raster } = this.scene;
    if (raster === null || this.known === null) return null;
    const { resolution_m, x_m, y_m } = raster.geometry;
    const { fromColumn, fromRow, toColumn, toRow } = this.known;
    return {
      minX: x_m + fromColumn * resolution_m, maxX: x_m + toColumn * resolution_m,
      minY: y_m + fromRow * resolution_m, maxY: y_m + toRow * resolution_m,
    };
  }
  private known: CellRect | null = null;
  private learn(rects: CellRect[]): void {
    const { raster } = this.scene;
    if (raster === null) return;
    for (const rect of rects) this.known = knownIn(raster, rect, this.known);
  }
  // Under who draws an area the map stays where it is.
  private refit(): void {
    if (this.scene.draft !== null || this.leader !== null) return;
    if (!this.fitted || this.untouched) this.fit();
  }
  fit(): void {
    const box = this.box();
    if (box === null) return;
    this.fitted = true;
    this.view.fit(box, TOOLS_HEIGHT + (this.beside === null ? 0 : CAPTION_HEIGHT), this.corner);
    this.draw();
  }
  // The raster, or all of it, is new.
  replaced(): void {
    this.picture.forget();
    const { raster } = this.scene;
    this.known = null;
    if (raster !== null) {
      this.learn([{ fromColumn: 0, fromRow: 0, toColumn: raster.geometry.columns, toRow: raster.geometry.rows }]);
    }
    this.refit();
    this.draw();
  }
  cellsChanged(rects: CellRect[]): void {
    this.picture.update(rects);
    this.learn(rects);
    this.refit();
    this.draw();
  }
  figuresChanged(): void {
    this.picture.rescaleIfNeeded();
    this.beside?.picture.rescaleIfNeeded();
    this.draw();
  }
  setCells(layer: CellLayer, log = this.picture.log): void {
    this.picture.layer = layer;
    this.picture.log = log;
    this.picture.forget();
    this.draw();
  }

  hueOf(robot: string): number {
    let hue = this.robotHues.get(robot);
    if (hue === undefined) {
      hue = ROBOT_HUES[this.robotHues.size % ROBOT_HUES.length];
      this.robotHues.set(robot, hue);
    }
    return hue;
  }
  colourOf(robot: string): string {
    return `hsl(${this.hueOf(robot)} 90% 55%)`;
  }

  draw(): void {
    this.beside?.draw();
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.drawNow();
      this.canvas.dataset.revision = String(this.revision); // for tests and benches
    });
  }

  private drawNow(): void {
    const { context: c, view, scene, marks } = this;
    const ratio = this.canvas.width / Math.max(1, view.width);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.fillStyle = theme('--map-unknown');
    c.fillRect(0, 0, view.width, view.height);
    if (scene.raster === null) return;
    this.picture.prepare();
    if (this.follow && scene.draft === null) this.centreOnRobot();
    const names = this.on.has('names');
    this.pen.grid();
    this.drawCells(scene.raster);
    if (this.picture.layer === 'objective') marks.judged();
    if (this.on.has('areas')) marks.areas(names);
    if (this.on.has('trails')) marks.trails();
    if (this.on.has('frontiers')) marks.frontiers(scene.raster);
    const why = scene.asksWhy && this.on.has('why') ? scene.why : null;
    if (why !== null) marks.candidates(why);
    if (this.on.has('ways')) marks.ways();
    if (this.on.has('claims')) marks.claims();
    if (why !== null) marks.goals(why);
    marks.robots(names);
    if (scene.asked !== null) marks.crosshair(scene.asked);
    if (this.pointed !== null) marks.crosshair(this.pointed);
    for (const source of scene.sources) this.pen.cross(source, theme('--bad'));
    if (scene.draft !== null) marks.draft(scene.draft);
    this.pen.scaleBar();
  }

  private centreOnRobot(): void {
    const robots = this.scene.status?.robots ?? [];
    const robot = robots.find((one) => one.robot === this.scene.robot) ?? robots[0];
    if (robot?.pose === undefined) return;
    this.view.centreX_m = robot.pose.xM;
    this.view.centreY_m = robot.pose.yM;
  }

  private drawCells(raster: Raster): void {
    const { x_m, y_m, columns, rows, resolution_m } = raster.geometry;
    const [x, y] = this.view.toPixel(x_m, y_m + rows * resolution_m);
    const size = this.view.scale * resolution_m;
    this.context.imageSmoothingEnabled = size < 1;
    this.context.drawImage(this.picture.canvas, x, y, columns * size, rows * size);
  }
}
