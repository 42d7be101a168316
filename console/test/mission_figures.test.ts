// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { MapStatusSchema, PlanSchema, RobotSchema } from '@plumescout/client/wire';
import { missionFigures } from '../src/mission_figures.ts';

const figures = { known_m2: 12, max_ppm: 30, min_ppm: 0, plume_m2: 4, mean_entropy_nats: -1 } as never;
const R1 = 'missions/hall/robots/r1';

test('nothing is charted before there is a map', () => {
  const status = create(MapStatusSchema, {});
  assert.deepEqual(missionFigures({ figures: null, status }, [], []), []);
  assert.deepEqual(missionFigures({ figures, status: null }, [], []), []);
});

test('figures of the mission, and lines of its robots', () => {
  const status = create(MapStatusSchema, { gasThresholdPpm: 2.5, robots: [{ robot: R1, appliedSequence: 7n }],
                                           objective: { undecidedAreaM2: 3.5 } });
  const robots = [create(RobotSchema, { onMap: { robot: R1 }, ingestLagS: 0.25 }), create(RobotSchema, {})];
  const found = missionFigures({ figures, status }, robots,
    [create(PlanSchema, { robot: R1, cpuDuration: { seconds: 0n, nanos: 20_000_000 } })]);
  const values = Object.fromEntries(found.map(({ title, robot, value }) => [`${title}|${robot}`, value]));
  assert.deepEqual(values, {
    'Known area|': 12, 'Undecided area|': 3.5, 'Largest gas mean|': 30, 'Plume (above 2.5 ppm)|': 4,
    'Mean entropy of the gas field|': -1, 'Readings in the posterior|': 0, [`Observations|${R1}`]: 7,
    [`CPU time of the latest plan|${R1}`]: 20, [`Age of the newest sample|${R1}`]: 0.25,
  });
});

test('missions without an objective have nothing undecided', () => {
  const titles = missionFigures({ figures, status: create(MapStatusSchema, {}) }, [], []).map(({ title }) => title);
  assert.ok(!titles.includes('Undecided area'));
});
