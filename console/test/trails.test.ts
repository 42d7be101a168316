// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { extendTrail } from '../src/trails.ts';
import type { Trails } from '../src/trails.ts';

const R1 = 'missions/hall/robots/r1', R2 = 'missions/hall/robots/r2';

test('each robot has a trail of its own, and one that was never seen has none', () => {
  const trails: Trails = new Map();
  extendTrail(trails, R1, { xM: 1, yM: 2 });
  extendTrail(trails, R2, { xM: 3, yM: 4 });
  extendTrail(trails, 'missions/hall/robots/r3', undefined);
  assert.deepEqual([...trails], [[R1, { points: [[1, 2]] }], [R2, { points: [[3, 4]] }]]);
});

test('who stands leaves no points, however long; who creeps does', () => {
  const trails: Trails = new Map();
  for (let i = 0; i < 100; ++i) extendTrail(trails, R1, { xM: 0.04 * (i % 2), yM: 0 });
  assert.deepEqual(trails.get(R1)!.points, [[0, 0]]);
  for (let i = 1; i <= 10; ++i) extendTrail(trails, R1, { xM: 0.02 * i, yM: 0 });
  assert.deepEqual(trails.get(R1)!.points.map(([x]) => Math.round(100 * x)), [0, 6, 12, 18]);
});

test('of a long way the oldest places go', () => {
  const trails: Trails = new Map();
  for (let i = 0; i < 5000; ++i) extendTrail(trails, R1, { xM: i, yM: 0 });
  const { points } = trails.get(R1)!;
  assert.deepEqual([points.length, points[0][0], points.at(-1)![0]], [4000, 1000, 4999]);
});
