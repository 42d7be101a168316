// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The map on a canvas: cells as a picture of their own, drawn scaled, and what lies on them as lines.
import type { AreaDraft, Place } from './area_draft.ts';
import { CellPicture } from './cell_picture.ts';
import type { CellLayer, Cells } from './cell_picture.ts';
import { MapPen } from './map_pen.ts';
import type { CellRect, Raster } from '@plumescout/client';
import type { JudgedSquare } from './objective_layer.ts';
import { theme } from './theme.ts';
import type { Trails } from './trails.ts';
import { View, knownIn } from './view.ts';
import type { Box, Corner } from './view.ts';
import type { LivePlan, MapStatus, Plan, Point2D, Polygon } from '@plumescout/client/wire';
import { GoalKind, RejectedGoal_Reason } from '@plumescout/client/wire';
import { shortName } from './words.ts';

export const SWITCHES = ['frontiers', 'ways', 'trails', 'claims', 'names', 'areas', 'why'] as const;
export type Switch = (typeof SWITCHES)[number];

export type { Place };

// Whatever lies on the map.
export type Scene = Cells & {
  status: MapStatus | null;
  plans: LivePlan[];
  why: Plan | null; // of the robot that is looked at
  asksWhy: boolean; // whether that is looked into
  candidate: number; // of it, pointed at; -1: none
  trails: Trails;
  keepOut: Polygon[];
  draft: AreaDraft | null; // of another one
  home: Point2D | undefined;
  robot: string; // that is looked at
  asked: Place | null; // the place that was clicked on
  sources: Place[]; // of gas, if somebody knows
  judged: JudgedSquare[]; // how the objective stands, where that is looked at
};

// What the buttons above the map take of it, pixels.
const TOOLS_HEIGHT = 40;
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
    this.view.fit(box, TOOLS_HEIGHT, this.corner);
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
    const { context: c, view, scene } = this;
    const ratio = this.canvas.width / Math.max(1, view.width);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.fillStyle = theme('--map-unknown');
    c.fillRect(0, 0, view.width, view.height);
    if (scene.raster === null) return;
    this.picture.prepare();
    if (this.follow && scene.draft === null) this.centreOnRobot();
    this.pen.grid();
    this.drawCells(scene.raster);
    if (this.picture.layer === 'objective') this.drawJudged();
    if (this.on.has('areas')) this.drawAreas();
    if (this.on.has('trails')) this.drawTrails();
    if (this.on.has('frontiers')) this.drawFrontiers(scene.raster);
    const why = scene.asksWhy && this.on.has('why') ? scene.why : null;
    if (why !== null) this.drawCandidates(why);
    if (this.on.has('ways')) this.drawWays();
    if (this.on.has('claims')) this.drawClaims();
    if (why !== null) this.drawGoals(why);
    this.drawRobots();
    if (scene.asked !== null) this.drawCrosshair(scene.asked);
    if (this.pointed !== null) this.drawCrosshair(this.pointed);
    for (const source of scene.sources) this.pen.cross(source, theme('--bad'));
    if (scene.draft !== null) this.drawDraft(scene.draft);
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

  private drawJudged(): void {
    const { context: c, view } = this;
    for (const { x_m, y_m, size_m, outlook } of this.scene.judged) {
      const [left, top] = view.toPixel(x_m - size_m / 2, y_m + size_m / 2);
      const [right, bottom] = view.toPixel(x_m + size_m / 2, y_m - size_m / 2);
      c.fillStyle = theme(`--judged-${outlook}`);
      // Whole pixels, so that no seams are seen.
      const x = Math.round(left), y = Math.round(top);
      c.fillRect(x, y, Math.round(right) - x, Math.round(bottom) - y);
    }
  }

  private drawAreas(): void {
    const { context: c, scene, view } = this;
    for (const area of scene.keepOut) {
      this.pen.path(area.vertices);
      c.closePath();
      c.fillStyle = theme('--map-keep-out');
      c.fill();
      c.setLineDash([6, 4]);
      this.pen.strokeTwice(theme('--bad'), 1.5);
      c.setLineDash([]);
      if (this.on.has('names')) this.nameArea(area);
    }
    if (scene.home === undefined) return;
    const [x, y] = view.toPixel(scene.home.xM, scene.home.yM);
    c.beginPath();
    c.moveTo(x - 8, y);
    c.lineTo(x, y - 8);
    c.lineTo(x + 8, y);
    c.moveTo(x - 5, y - 2);
    c.lineTo(x - 5, y + 7);
    c.lineTo(x + 5, y + 7);
    c.lineTo(x + 5, y - 2);
    this.pen.strokeTwice(theme('--map-ink'), 2);
  }

  // In the middle of its box.
  private nameArea({ name, vertices }: Polygon): void {
    const xs = vertices.map((one) => one.xM), ys = vertices.map((one) => one.yM);
    const [x, y] = this.view.toPixel((Math.min(...xs) + Math.max(...xs)) / 2,
                                     (Math.min(...ys) + Math.max(...ys)) / 2);
    this.pen.label(name, x, y, 'center', 'middle');
  }

  private drawDraft(draft: AreaDraft): void {
    const { context: c } = this;
    const outline = draft.outline().map(({ x_m, y_m }) => ({ xM: x_m, yM: y_m }));
    if (outline.length === 0) return;
    this.pen.path(outline);
    if (outline.length > 2) {
      c.closePath();
      c.fillStyle = theme('--map-keep-out');
      c.fill();
    }
    this.pen.strokeTwice(theme('--bad'), 2.5);
    for (const { xM, yM } of outline) {
      const [x, y] = this.view.toPixel(xM, yM);
      c.beginPath();
      c.arc(x, y, 4, 0, 2 * Math.PI);
      this.pen.strokeTwice(theme('--bad'), 2);
    }
  }

  private drawTrails(): void {
    for (const [robot, trail] of this.scene.trails) {
      this.pen.path(trail.points.map(([xM, yM]) => ({ xM, yM })));
      this.context.globalAlpha = 0.9;
      this.pen.strokeTwice(this.colourOf(robot), 1.75, 1);
      this.context.globalAlpha = 1;
    }
  }

  private drawFrontiers(raster: Raster): void {
    const { context: c, view } = this;
    const full = this.scene.status?.geometry;
    const size_m = full?.resolutionM ?? raster.geometry.resolution_m;
    const x_m = full?.origin?.xM ?? raster.geometry.x_m, y_m = full?.origin?.yM ?? raster.geometry.y_m;
    const size = Math.max(2, view.scale * size_m);
    for (const frontier of this.scene.status?.frontiers ?? []) {
      const gas = frontier.kind === GoalKind.GAS_FRONTIER;
      c.fillStyle = theme(gas ? '--frontier-gas' : '--frontier-occupancy');
      c.globalAlpha = frontier.tooSmall || !frontier.reachable ? 0.4 : 0.95;
      for (let i = 0; i < frontier.cellColumns.length; ++i) {
        const [x, y] = view.toPixel(x_m + (frontier.cellColumns[i] + 0.5) * size_m,
                                    y_m + (frontier.cellRows[i] + 0.5) * size_m);
        c.fillRect(x - size / 2, y - size / 2, size, size);
      }
      c.globalAlpha = 1;
      if (frontier.centroid === undefined || frontier.tooSmall) continue;
      const [x, y] = view.toPixel(frontier.centroid.xM, frontier.centroid.yM);
      c.beginPath();
      // The kinds differ in shape, too.
      if (gas) {
        c.moveTo(x, y - 6);
        c.lineTo(x + 6, y);
        c.lineTo(x, y + 6);
        c.lineTo(x - 6, y);
        c.closePath();
      } else {
        c.rect(x - 4.5, y - 4.5, 9, 9);
      }
      this.pen.strokeTwice(theme(gas ? '--frontier-gas' : '--frontier-occupancy'), 2);
    }
  }

  private drawCandidates(plan: Plan): void {
    const { context: c, scene } = this;
    plan.candidates.forEach((candidate, i) => {
      if (i === plan.chosenIndex) return;
      this.pen.path(candidate.path);
      c.setLineDash(i === scene.candidate ? [] : [3, 4]);
      this.pen.strokeTwice(theme('--map-ink'), i === scene.candidate ? 3 : 1);
      c.setLineDash([]);
    });
  }

  private drawGoals(plan: Plan): void {
    plan.candidates.forEach((candidate, i) => {
      if (candidate.goal?.position !== undefined) {
        this.pen.disc(candidate.goal.position, String(i + 1), i === plan.chosenIndex);
      }
    });
    for (const rejected of plan.rejectedGoals) {
      const at = rejected.goal?.position;
      // Specks of frontiers are many, and nobody asks why not.
      if (at === undefined || rejected.reason === RejectedGoal_Reason.TOO_SMALL) continue;
      this.pen.cross({ x_m: at.xM, y_m: at.yM }, theme('--bad'), 4, 1.5);
    }
  }

  private drawWays(): void {
    const { scene } = this;
    for (const plan of scene.plans) {
      const points = plan.trajectory?.waypoints.flatMap((one) => one.pose ?? []) ?? [];
      if (points.length < 2) continue;
      this.pen.path(points);
      this.pen.strokeTwice(this.colourOf(plan.robot), plan.robot === scene.robot ? 3.5 : 2.5);
    }
  }

  private drawClaims(): void {
    const { context: c } = this;
    for (const plan of this.scene.plans) {
      if (plan.goal === undefined) continue;
      const [x, y] = this.view.toPixel(plan.goal.xM, plan.goal.yM);
      c.beginPath();
      c.arc(x, y, 7, 0, 2 * Math.PI);
      this.pen.strokeTwice(this.colourOf(plan.robot), 2.5);
    }
  }

  private drawRobots(): void {
    const { context: c, view, scene } = this;
    for (const robot of scene.status?.robots ?? []) {
      if (robot.pose === undefined) continue;
      const [x, y] = view.toPixel(robot.pose.xM, robot.pose.yM);
      const radius = Math.max(7, robot.radiusM * view.scale);
      const yaw = -robot.pose.yawRad;
      c.globalAlpha = robot.silent ? 0.5 : 1;
      c.beginPath();
      c.arc(x, y, radius, yaw + 0.6, yaw - 0.6 + 2 * Math.PI);
      c.lineTo(x + 1.75 * radius * Math.cos(yaw), y + 1.75 * radius * Math.sin(yaw));
      c.closePath();
      c.fillStyle = this.colourOf(robot.robot);
      c.fill();
      c.strokeStyle = theme(robot.robot === scene.robot ? '--map-ink' : '--map-rim');
      c.lineWidth = robot.robot === scene.robot ? 2.5 : 1.5;
      c.stroke();
      if (this.on.has('names')) {
        const text = shortName(robot.robot) + (robot.silent ? ' (silent)' : robot.frameSuspect ? ' (lost)' : '');
        this.pen.label(text, x + 1.9 * radius, y - radius, 'left', 'middle');
      }
      c.globalAlpha = 1;
    }
  }

  private drawCrosshair(at: Place): void {
    const [x, y] = this.view.toPixel(at.x_m, at.y_m);
    const c = this.context;
    c.beginPath();
    c.moveTo(x - 10, y);
    c.lineTo(x - 3, y);
    c.moveTo(x + 3, y);
    c.lineTo(x + 10, y);
    c.moveTo(x, y - 10);
    c.lineTo(x, y - 3);
    c.moveTo(x, y + 3);
    c.lineTo(x, y + 10);
    this.pen.strokeTwice(theme('--map-ink'), 2);
  }
}
