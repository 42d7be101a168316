// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import { MissionPhase } from './wire/index.ts';
import type { Plan as PlanMessage } from './wire/index.ts';

/** Where to drive. Arrays have one number for each waypoint; the first is the start. Between two of
 * them speed changes evenly; if it is 0 at both, it is constant. Where two lie at one place the robot
 * turns on the spot. */
export type Plan = {
  name: string; // missions/{mission}/plans/{plan}; empty before it is committed
  complete: boolean; // the mission is: there is nowhere to go
  explanation: string; // one sentence, for people
  x_m: Float64Array; // frame map
  y_m: Float64Array;
  yaw_rad: Float64Array;
  arrival_s: Float64Array; // since departure
  dwell_s: Float64Array; // standing time
  speed_mps: Float64Array; // in passing
  length_m: number;
  duration_s: number; // with standing
  message: PlanMessage; // all candidates with their costs, and the goals that were left out
};

export function planOf(message: PlanMessage): Plan {
  const points = message.trajectory?.waypoints ?? [];
  return {
    name: message.name,
    complete: message.phase === MissionPhase.COMPLETE,
    explanation: message.explanation,
    x_m: Float64Array.from(points, (point) => point.pose?.xM ?? 0),
    y_m: Float64Array.from(points, (point) => point.pose?.yM ?? 0),
    yaw_rad: Float64Array.from(points, (point) => point.pose?.yawRad ?? 0),
    arrival_s: Float64Array.from(points, (point) => point.arrivalTimeS),
    dwell_s: Float64Array.from(points, (point) => point.dwellS),
    speed_mps: Float64Array.from(points, (point) => point.speedMps),
    length_m: message.trajectory?.lengthM ?? 0,
    duration_s: message.trajectory?.durationS ?? 0,
    message,
  };
}
