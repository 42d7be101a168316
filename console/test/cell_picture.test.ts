// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { scaleOf } from '../src/cell_picture.ts';
import type { Cells } from '../src/cell_picture.ts';

const cells = (max_ppm: number, p99_stddev_ppm: number, beside: Cells | null = null): Cells => ({
  raster: null, then: null, threshold_ppm: 0.2, beside,
  figures: { known_m2: 1, free_m2: 1, plume_m2: 0, max_ppm, max_stddev_ppm: 500, p99_stddev_ppm, mean_entropy_nats: 0 } });

test('a map alone is on its own scale', () => {
  assert.deepEqual(scaleOf('mean', false, cells(18, 3), null), { min: 0, max: 20, log: false });
  assert.deepEqual(scaleOf('uncertainty', false, cells(18, 3), null), { min: 0, max: 5, log: false });
});

test('maps beside each other are on one scale, that of the larger', () => {
  const [low, high] = [cells(18, 3), cells(45, 8)];
  [low.beside, high.beside] = [high, low];
  for (const layer of ['mean', 'uncertainty'] as const) {
    assert.deepEqual(scaleOf(layer, false, low, null), scaleOf(layer, false, high, null));
  }
  assert.equal(scaleOf('mean', true, low, null).max, 50);
  assert.equal(scaleOf('uncertainty', false, low, null).max, 10);
});
