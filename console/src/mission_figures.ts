// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What is charted of a mission at one moment.
import { GoalKind } from '@plumescout/client/wire';
import type { MapStatus, MissionFigures as Figures, Plan, Robot } from '@plumescout/client/wire';
import { countersOf, isFirst, ofGas } from './gases.ts';
import type { Gases } from './gases.ts';
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

// A map in figures; those of gas are of the one that is looked at.
type Measured = {
  reachable_m2: number;
  observed_m2: number;
  openFrontiers: number;
  known_m2: number;
  undecided_m2: number | undefined;
  max_ppm: number;
  plume_m2: number;
  entropy_nats: number;
  inPosterior: number;
  applied: { robot: string; appliedSequence: bigint }[];
};

function chartsOf(measured: Measured, threshold_ppm: number, gases: Gases): MissionFigure[] {
  const found: MissionFigure[] = [];
  const add = (title: string, unit: string, value: number, robot = '') => found.push({ title, unit, robot, value });
  const first = ofGas({ ...gases, looked: '' }), looked = ofGas(gases);
  if (measured.reachable_m2 > 0) add(`Completeness${first}`, '%', (100 * measured.observed_m2) / measured.reachable_m2);
  add('Open frontiers of the map', '', measured.openFrontiers);
  add('Known area', 'm²', measured.known_m2);
  if (measured.undecided_m2 !== undefined) add('Undecided area', 'm²', measured.undecided_m2);
  add(`Largest gas mean${looked}`, 'ppm', measured.max_ppm);
  if (isFirst(gases)) add(`Plume${looked} (above ${figure(threshold_ppm)} ppm)`, 'm²', measured.plume_m2);
  add(`Mean entropy of the gas field${looked}`, 'nats', measured.entropy_nats);
  add(`Readings in the posterior${looked}`, '', measured.inPosterior);
  for (const { robot, appliedSequence } of measured.applied) add('Observations', '', Number(appliedSequence), robot);
  return found;
}

// `latest`: the latest plan of each robot. None before there are a map and its status.
export function missionFigures(scene: Pick<Scene, 'figures' | 'status' | 'gases'>, robots: Robot[],
                               latest: Plan[]): MissionFigure[] {
  const { figures, status, gases } = scene;
  if (figures === null || status === null) return [];
  const found = chartsOf({
    reachable_m2: status.reachableAreaM2, observed_m2: status.observedAreaM2, openFrontiers: openFrontiers(status),
    known_m2: figures.known_m2, undecided_m2: status.objective?.undecidedAreaM2, max_ppm: figures.max_ppm,
    plume_m2: figures.plume_m2, entropy_nats: figures.mean_entropy_nats,
    inPosterior: Number(countersOf(status, gases)?.inPosteriorCount ?? 0), applied: status.robots,
  }, status.gasThresholdPpm, gases);
  const add = (title: string, unit: string, value: number, robot = '') => found.push({ title, unit, robot, value });
  for (const { robot, cpuDuration } of latest) {
    const cpu_ms = 1e3 * Number(cpuDuration?.seconds ?? 0) + 1e-6 * (cpuDuration?.nanos ?? 0);
    add('CPU time of the latest plan', 'ms', cpu_ms, robot);
  }
  for (const { ingestLagS, onMap } of robots) {
    if (ingestLagS !== undefined) add('Age of the newest sample', 's', ingestLagS, onMap?.robot);
  }
  return found;
}

// As a server that replayed the journal tells them: without plans and ages.
export function figuresThen(then: Figures, threshold_ppm: number, gases: Gases): MissionFigure[] {
  const gas = then.gases.find(({ species }) => species === gases.looked) ?? then.gases[0];
  return chartsOf({
    reachable_m2: then.reachableAreaM2, observed_m2: then.observedAreaM2, openFrontiers: then.openFrontierCount,
    known_m2: then.knownAreaM2, undecided_m2: then.undecidedAreaM2, max_ppm: gas?.maxMeanPpm ?? NaN,
    plume_m2: gas?.plumeAreaM2 ?? NaN, entropy_nats: gas?.meanEntropyNats ?? NaN,
    inPosterior: Number(gas?.inPosteriorCount ?? 0), applied: then.robots,
  }, threshold_ppm, gases);
}
