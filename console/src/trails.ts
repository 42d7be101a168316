// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Where robots were since the page was opened.

const MAX_TRAIL_POINTS = 4000;
const TRAIL_STEP_M = 0.05;

export type Trails = Map<string, { points: [number, number][] }>; // by robot; x, y in metres

// Adds the place of a robot that has moved on; the oldest places go.
export function extendTrail(trails: Trails, robot: string, at: { xM: number; yM: number } | undefined): void {
  if (at === undefined) return;
  let trail = trails.get(robot);
  if (trail === undefined) {
    trail = { points: [] };
    trails.set(robot, trail);
  }
  const last = trail.points.at(-1);
  if (last !== undefined && Math.hypot(last[0] - at.xM, last[1] - at.yM) < TRAIL_STEP_M) return;
  trail.points.push([at.xM, at.yM]);
  if (trail.points.length > MAX_TRAIL_POINTS) trail.points.shift();
}
