// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What is charted of a mission at one moment.
import { GoalKind } from '@plumescout/client/wire';
import type { MapStatus, Plan, Robot } from '@plumescout/client/wire';
import { countersOf, isFirst, ofGas } from './gases.ts';
import type { Scene } from './scene.ts';
import { figure } from './words.ts';

// `robot`: the resource name of whose figure it is; empty: of the mission.
export type MissionFigure = { title: string; unit: string; robot: string; value: number };

// What counts, of figures whose names do not say it.
export const WHAT_COUNTS: [string, string][] = [
  ['Completeness', 'the share of the mapped ground whose gas counts as observed. Mapped ground is where robots may ' +
    'stand and can get to from where they are or began. Gas counts as observed where its variance is as low as ' +
    'where somebody measured. What lies behind frontiers is not in it: new ground lowers it.'],
  ['Open frontiers of the map', 'borders to unknown space that a robot can reach and that are large enough to go to. ' +
    'The map is complete once none is left.'],
  ['Undecided area', 'of a mission with an objective: where robots can get to and what is asked is not sure yet.'],
  ['Plume', 'where the gas mean is above the threshold that gas frontiers go by.'],
  ['Mean entropy', 'of one free cell: half the logarithm of 2πe times its variance.'],
];

function openFrontiers({ frontiers }: MapStatus): number {
  return frontiers.filter((one) => one.kind === GoalKind.OCCUPANCY_FRONTIER && one.reachable && !one.tooSmall).length;
}

// `latest`: the latest plan of each robot. None before there are a map and its status.
export function missionFigures(scene: Pick<Scene, 'figures' | 'status' | 'gases'>, robots: Robot[],
                               latest: Plan[]): MissionFigure[] {
  const { figures, status, gases } = scene;
  if (figures === null || status === null) return [];
  const found: MissionFigure[] = [];
  const add = (title: string, unit: string, value: number, robot = '') => found.push({ title, unit, robot, value });
  const first = ofGas({ ...gases, looked: '' }), looked = ofGas(gases);
  if (status.reachableAreaM2 > 0) add(`Completeness${first}`, '%', (100 * status.observedAreaM2) / status.reachableAreaM2);
  add('Open frontiers of the map', '', openFrontiers(status));
  add('Known area', 'm²', figures.known_m2);
  if (status.objective !== undefined) add('Undecided area', 'm²', status.objective.undecidedAreaM2);
  add(`Largest gas mean${looked}`, 'ppm', figures.max_ppm);
  if (isFirst(gases)) add(`Plume${looked} (above ${figure(status.gasThresholdPpm)} ppm)`, 'm²', figures.plume_m2);
  add(`Mean entropy of the gas field${looked}`, 'nats', figures.mean_entropy_nats);
  add(`Readings in the posterior${looked}`, '', Number(countersOf(status, gases)?.inPosteriorCount ?? 0));
  for (const { robot, appliedSequence } of status.robots) add('Observations', '', Number(appliedSequence), robot);
  for (const { robot, cpuDuration } of latest) {
    const cpu_ms = 1e3 * Number(cpuDuration?.seconds ?? 0) + 1e-6 * (cpuDuration?.nanos ?? 0);
    add('CPU time of the latest plan', 'ms', cpu_ms, robot);
  }
  for (const { ingestLagS, onMap } of robots) {
    if (ingestLagS !== undefined) add('Age of the newest sample', 's', ingestLagS, onMap?.robot);
  }
  return found;
}
