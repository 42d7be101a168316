// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { mapYamlOf, npyOf, pgmOf } from '../src/export.ts';
import { FREE, OCCUPIED, Raster } from '../src/raster.ts';

test('npy has a header of a multiple of 64 bytes, then the values', () => {
  const bytes = npyOf(Float32Array.of(1, 2, 3, 4, 5, NaN), 2, 3);
  const length = bytes[8] | (bytes[9] << 8);
  assert.equal((10 + length) % 64, 0);
  const header = new TextDecoder().decode(bytes.subarray(10, 10 + length));
  assert.match(header, /^\{'descr': '<f4', 'fortran_order': False, 'shape': \(2, 3\), \} *\n$/);
  const view = new DataView(bytes.buffer, 10 + length);
  assert.equal(view.byteLength, 24);
  assert.equal(view.getFloat32(16, true), 5);
});

test('images of maps begin in the north-west', () => {
  const raster = new Raster({ x_m: -1, y_m: 2, resolution_m: 0.1, columns: 2, rows: 2 });
  raster.occupancy.set([FREE, OCCUPIED, 0, FREE]);
  const bytes = pgmOf(raster);
  assert.deepEqual([...bytes.subarray(-4)], [205, 254, 254, 0]);
  assert.match(mapYamlOf(raster, 'm.pgm'), /image: m.pgm\n[^]*origin: \[-1, 2, 0\]/);
});
