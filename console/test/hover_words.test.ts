// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { FREE, OCCUPIED, Raster } from '@plumescout/client';
import { cellInWords, cellsInWords } from '../src/hover_words.ts';

// Three cells of a metre in a row from the origin: free with gas, occupied, unknown.
function row(mean_ppm: number): Raster {
  const raster = new Raster({ x_m: 0, y_m: 0, resolution_m: 1, columns: 3, rows: 1 });
  raster.occupancy.set([FREE, OCCUPIED]);
  raster.mean_ppm[0] = mean_ppm;
  raster.variance_ppm2[0] = 0.25;
  return raster;
}
const at = (x_m: number) => ({ x_m, y_m: 0.5 });

test('a place tells its state, and gas if it has some', () => {
  assert.equal(cellInWords(row(2), at(0.5)), 'free · 2 ± 0.5 ppm');
  assert.equal(cellInWords(row(2), at(1.5)), 'occupied');
  assert.equal(cellInWords(row(2), at(2.5)), 'unknown');
  assert.equal(cellInWords(row(2), at(3.5)), 'off the map');
  assert.equal(cellInWords(null, at(0.5)), 'off the map');
});

test('a place tells what it held then and holds now', () => {
  assert.equal(cellsInWords(row(1.5), row(2), at(0.5)), 'then 1.5 ± 0.5 ppm · now 2 ± 0.5 ppm · change +0.5 ppm');
  assert.equal(cellsInWords(row(3), row(2), at(0.5)), 'then 3 ± 0.5 ppm · now 2 ± 0.5 ppm · change -1 ppm');
});

test('what one moment does not know has not changed', () => {
  assert.equal(cellsInWords(null, row(2), at(0.5)), 'then off the map · now 2 ± 0.5 ppm');
  assert.equal(cellsInWords(row(1), row(2), at(1.5)), 'then occupied · now occupied');
});
