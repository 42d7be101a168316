// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What a runner prints of what came back; see README.md.
import { createHash } from 'node:crypto';
import { Raster } from '@plumescout/client';
import type { DecodedMap, Plan, RobotNotice } from '@plumescout/client';
import * as wire from '@plumescout/client/wire';

export const lastPart = (name: string) => name.slice(name.lastIndexOf('/') + 1);
const sha256 = (data: Uint8Array) => createHash('sha256').update(data).digest('hex');
const reasonOf = (value: wire.RejectedGoal_Reason) =>
  (value === wire.RejectedGoal_Reason.UNSPECIFIED ? null : wire.RejectedGoal_Reason[value]);

export function mission(message: wire.Mission) {
  const idle = message.idleTimeToLive;
  return {
    mission: lastPart(message.name),
    state: wire.MissionState[message.state],
    phase: wire.MissionPhase[message.phase],
    robot_count: message.robotCount,
    event_retention: wire.EventRetention[message.eventRetention],
    idle_time_to_live_s: idle === undefined ? null : Number(idle.seconds) + idle.nanos * 1e-9,
  };
}

export function plan({ message, ...path }: Plan) {
  const count = path.x_m.length;
  const numbers = new Float64Array(6 * count);
  [path.x_m, path.y_m, path.yaw_rad, path.arrival_s, path.dwell_s, path.speed_mps].forEach((column, j) =>
    column.forEach((value, i) => { numbers[6 * i + j] = value; }));
  const goal = message.candidates[message.chosenIndex]?.goal;
  return {
    named: path.name !== '',
    end: wire.Plan_End[message.end],
    phase: wire.MissionPhase[message.phase],
    goal_kind: goal === undefined ? null : wire.GoalKind[goal.kind],
    length_m: path.length_m,
    duration_s: path.duration_s,
    waypoints: count,
    sha256: sha256(new Uint8Array(numbers.buffer)),
  };
}

export function check(message: wire.CheckTrajectoryResponse) {
  return {
    blocked: message.blockage === undefined ? null : wire.CellState[message.blockage.state],
    rejected: reasonOf(message.rejectedGoal?.reason ?? wire.RejectedGoal_Reason.UNSPECIFIED),
    length_m: message.rest?.lengthM ?? null,
  };
}

export function frontier(message: wire.FrontierGoal) {
  return {
    kind: wire.GoalKind[message.goal!.kind],
    reason: reasonOf(message.reason),
    travel_m: message.travelM ?? null,
    x_m: message.goal!.position!.xM,
    y_m: message.goal!.position!.yM,
    cells: message.goal!.frontierCellCount,
  };
}

export function livePlan(message: wire.LivePlan) {
  return {
    robot: lastPart(message.robot),
    goal_kind: wire.GoalKind[message.goalKind],
    x_m: message.goal!.xM,
    y_m: message.goal!.yM,
    waypoints: message.trajectory!.waypoints.length,
  };
}

export function team(plans: { plans: Plan[]; leftOut: wire.PlanTeamResponse_LeftOut[] }) {
  return {
    plans: plans.plans.map((one) => ({ robot: lastPart(one.message.robot), ...plan(one) })),
    left_out: plans.leftOut.map((one) => lastPart(one.robot)),
  };
}

export function robot(message: wire.Robot) {
  const seen = message.onMap!;
  return {
    robot: lastPart(seen.robot),
    leased: message.leased,
    applied_sequence: Number(seen.appliedSequence),
    rejected_count: Number(seen.rejectedObservationCount),
    battery_share: message.batteryShare ?? null,
    ordered_home: message.orderedHome,
    live_plan: message.livePlan !== '',
    pose: seen.pose === undefined ? null : [seen.pose.xM, seen.pose.yM, seen.pose.yawRad],
  };
}

export function standing(notice: RobotNotice) {
  if (notice.case !== 'standing') throw new Error(`the first notice is ${notice.case}`);
  const flags = notice.value;
  return { standing: wire.RobotStandingSchema.fields
    .filter((field) => flags[field.localName as 'paused']).map((field) => field.name) };
}

export function event(message: wire.MissionEvent) {
  return { kind: wire.MissionEventKind[message.kind], robot: lastPart(message.robot) || null };
}

export function figures({ knownAreaM2, gases, robots }: wire.MissionFigures) {
  return { known_area_m2: knownAreaM2, readings: gases.map((gas) => Number(gas.inPosteriorCount)),
           robots: robots.map(({ robot }) => lastPart(robot)) };
}

export function area({ raster, status }: DecodedMap, layers: string[] = []) {
  const { geometry, occupancy, mean_ppm, variance_ppm2 } =
    raster ?? new Raster({ x_m: 0, y_m: 0, resolution_m: 0, columns: 0, rows: 0 });
  const digests = { occupancy: occupancy, gas_mean: bytesOf(mean_ppm), gas_variance: bytesOf(variance_ppm2) };
  return {
    rows: geometry.rows,
    columns: geometry.columns,
    resolution_m: geometry.resolution_m,
    origin: [geometry.x_m, geometry.y_m],
    robots: status.robots.map((one) => lastPart(one.robot)),
    reading_count: Number(status.gasCounters?.readingCount ?? 0n),
    frontier_count: status.frontiers.length,
    phase: wire.MissionPhase[status.phase],
    ...Object.fromEntries(Object.entries(digests)
      .filter(([layer]) => layers.length === 0 || layers.includes(layer.toUpperCase()))
      .map(([layer, cells]) => [`${layer}_sha256`, sha256(cells)])),
  };
}

// Little-endian, every NaN the same.
function bytesOf(cells: Float32Array): Uint8Array {
  const bytes = new Uint8Array(4 * cells.length);
  const view = new DataView(bytes.buffer);
  cells.forEach((value, i) => {
    if (Number.isNaN(value)) view.setUint32(4 * i, 0x7fc00000, true);
    else view.setFloat32(4 * i, value, true);
  });
  return bytes;
}
