// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What lies on a map, drawn over its cells: areas, ways, goals, robots.
import type { AreaDraft } from './area_draft.ts';
import type { MapPen } from './map_pen.ts';
import type { Raster } from '@plumescout/client';
import type { Place, Scene } from './scene.ts';
import { theme } from './theme.ts';
import type { View } from './view.ts';
import type { Plan, Point2D, Polygon } from '@plumescout/client/wire';
import { GoalKind, RejectedGoal_Reason } from '@plumescout/client/wire';
import { shortName } from './words.ts';

export class MapMarks {
  constructor(private readonly context: CanvasRenderingContext2D, private readonly view: View,
              private readonly pen: MapPen, private readonly scene: Scene,
              private readonly colourOf: (robot: string) => string) {}

  judged(): void {
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

  areas(names: boolean): void {
    const { context: c, scene } = this;
    for (const area of scene.keepOut) {
      this.pen.path(area.vertices);
      c.closePath();
      c.fillStyle = theme('--map-keep-out');
      c.fill();
      c.setLineDash([6, 4]);
      this.pen.strokeTwice(theme('--bad'), 1.5);
      c.setLineDash([]);
      if (names) this.nameArea(area);
    }
    for (const home of scene.homes) this.home(home);
  }

  // A house.
  private home({ xM, yM }: Point2D): void {
    const { context: c } = this;
    const [x, y] = this.view.toPixel(xM, yM);
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

  draft(draft: AreaDraft): void {
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

  trails(): void {
    for (const [robot, trail] of this.scene.trails) {
      this.pen.path(trail.points.map(([xM, yM]) => ({ xM, yM })));
      this.context.globalAlpha = 0.9;
      this.pen.strokeTwice(this.colourOf(robot), 1.75, 1);
      this.context.globalAlpha = 1;
    }
  }

  frontiers(raster: Raster): void {
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

  candidates(plan: Plan): void {
    const { context: c, scene } = this;
    plan.candidates.forEach((candidate, i) => {
      if (i === plan.chosenIndex) return;
      this.pen.path(candidate.path);
      c.setLineDash(i === scene.candidate ? [] : [3, 4]);
      this.pen.strokeTwice(theme('--map-ink'), i === scene.candidate ? 3 : 1);
      c.setLineDash([]);
    });
  }

  goals(plan: Plan): void {
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

  ways(): void {
    const { scene } = this;
    for (const plan of scene.plans) {
      const points = plan.trajectory?.waypoints.flatMap((one) => one.pose ?? []) ?? [];
      if (points.length < 2) continue;
      this.pen.path(points);
      this.pen.strokeTwice(this.colourOf(plan.robot), plan.robot === scene.robot ? 3.5 : 2.5);
    }
  }

  claims(): void {
    const { context: c } = this;
    for (const plan of this.scene.plans) {
      if (plan.goal === undefined) continue;
      const [x, y] = this.view.toPixel(plan.goal.xM, plan.goal.yM);
      c.beginPath();
      c.arc(x, y, 7, 0, 2 * Math.PI);
      this.pen.strokeTwice(this.colourOf(plan.robot), 2.5);
    }
  }

  robots(names: boolean): void {
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
      if (names) {
        const text = shortName(robot.robot) + (robot.silent ? ' (silent)' : robot.frameSuspect ? ' (lost)' : '');
        this.pen.label(text, x + 1.9 * radius, y - radius, 'left', 'middle');
      }
      c.globalAlpha = 1;
    }
  }

  crosshair(at: Place): void {
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
