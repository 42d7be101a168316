// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { GoalKind, MapStatusSchema, MissionFiguresSchema, PlanSchema, RobotSchema } from '@plumescout/client/wire';
import { WHAT_COUNTS, figuresThen, missionFigures } from '../src/mission_figures.ts';

const figures = { known_m2: 12, max_ppm: 30, min_ppm: 0, plume_m2: 4, mean_entropy_nats: -1 } as never;
const frontier = (other: object) => ({ kind: GoalKind.OCCUPANCY_FRONTIER, reachable: true, ...other });
const gases = { names: [], looked: '' };
const R1 = 'missions/hall/robots/r1';

test('nothing is charted before there is a map', () => {
  const status = create(MapStatusSchema, {});
  assert.deepEqual(missionFigures({ figures: null, status, gases }, [], []), []);
  assert.deepEqual(missionFigures({ figures, status: null, gases }, [], []), []);
});

test('figures of the mission, and lines of its robots', () => {
  const status = create(MapStatusSchema, { gasThresholdPpm: 2.5, robots: [{ robot: R1, appliedSequence: 7n }],
                                           objective: { undecidedAreaM2: 3.5 },
                                           reachableAreaM2: 8, observedAreaM2: 2,
                                           frontiers: [frontier({}), frontier({ tooSmall: true }),
                                             frontier({ reachable: false }),
                                             frontier({ kind: GoalKind.GAS_FRONTIER })] });
  const robots = [create(RobotSchema, { onMap: { robot: R1 }, ingestLagS: 0.25 }), create(RobotSchema, {})];
  const found = missionFigures({ figures, status, gases }, robots,
    [create(PlanSchema, { robot: R1, cpuDuration: { seconds: 0n, nanos: 20_000_000 } })]);
  const values = Object.fromEntries(found.map(({ title, robot, value }) => [`${title}|${robot}`, value]));
  assert.deepEqual(values, {
    'Completeness|': 25, 'Open frontiers of the map|': 1, 'Known area|': 12, 'Undecided area|': 3.5, 'Largest gas mean|': 30, 'Plume (above 2.5 ppm)|': 4,
    'Mean entropy of the gas field|': -1, 'Readings in the posterior|': 0, [`Observations|${R1}`]: 7,
    [`CPU time of the latest plan|${R1}`]: 20, [`Age of the newest sample|${R1}`]: 0.25,
  });
});

test('missions without an objective have nothing undecided', () => {
  const titles = missionFigures({ figures, status: create(MapStatusSchema, {}), gases }, [], []).map(({ title }) => title);
  assert.ok(!titles.includes('Undecided area'));
});

test('before a robot can reach anything, nothing is a share of it', () => {
  const titles = missionFigures({ figures, status: create(MapStatusSchema, {}), gases }, [], []).map(({ title }) => title);
  assert.ok(!titles.includes('Completeness'));
});

test('what counts is told of figures that there are', () => {
  const status = create(MapStatusSchema, { reachableAreaM2: 1, objective: {} });
  const titles = missionFigures({ figures, status, gases }, [], []).map(({ title }) => title);
  for (const [name] of WHAT_COUNTS) assert.ok(titles.some((title) => title.startsWith(name)), name);
});

test('of several gases it is said which one a figure is of, and there is a plume of the first alone', () => {
  const status = create(MapStatusSchema, { reachableAreaM2: 1, gasCounters: { inPosteriorCount: 5n }, gases: [
    { species: 'methane', gasCounters: { inPosteriorCount: 5n } }, { species: 'ammonia', gasCounters: { inPosteriorCount: 3n } }] });
  const of = (looked: string) => Object.fromEntries(
    missionFigures({ figures, status, gases: { names: ['methane', 'ammonia'], looked } }, [], [])
      .map(({ title, value }) => [title, value]));
  const [first, second] = [of(''), of('ammonia')];
  assert.equal(first['Readings in the posterior of methane'], 5);
  assert.equal(second['Readings in the posterior of ammonia'], 3);
  assert.ok('Completeness of methane' in second);
  assert.ok('Plume of methane (above 0 ppm)' in first);
  assert.ok(!Object.keys(second).some((title) => title.startsWith('Plume')));
});

test('what was is charted as what is, of the gas that is looked at', () => {
  const then = create(MissionFiguresSchema, { knownAreaM2: 12, reachableAreaM2: 8, observedAreaM2: 2, openFrontierCount: 1,
    undecidedAreaM2: 3.5, gases: [{ species: 'methane', maxMeanPpm: 30, plumeAreaM2: 4, meanEntropyNats: -1, inPosteriorCount: 5n },
      { species: 'ammonia', maxMeanPpm: 7 }], robots: [{ robot: R1, appliedSequence: 7n }] });
  const status = create(MapStatusSchema, { gasThresholdPpm: 2.5, robots: [{ robot: R1, appliedSequence: 7n }],
    objective: { undecidedAreaM2: 3.5 }, reachableAreaM2: 8, observedAreaM2: 2, frontiers: [frontier({})],
    gases: [{ species: 'methane', gasCounters: { inPosteriorCount: 5n } }, { species: 'ammonia' }] });
  const first = { names: ['methane', 'ammonia'], looked: '' };
  assert.deepEqual(figuresThen(then, 2.5, first),
                   missionFigures({ figures, status: { ...status, gasCounters: status.gases[0].gasCounters }, gases: first }, [], []));
  const of = Object.fromEntries(figuresThen(then, 0, { ...first, looked: 'ammonia' }).map(({ title, value }) => [title, value]));
  assert.equal(of['Largest gas mean of ammonia'], 7);
  assert.ok(!Object.keys(of).some((title) => title.startsWith('Plume')));
});
