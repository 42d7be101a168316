// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { encodeRanges } from '../src/ranges.ts';

const countsOf = ({ ranges_u16 }: { ranges_u16: Uint8Array }) => {
  const view = new DataView(ranges_u16.buffer);
  return Array.from({ length: ranges_u16.length / 2 }, (_, i) => view.getUint16(2 * i, true));
};

test('ranges are counts of 5 mm', () => {
  const encoded = encodeRanges([1, 0.005, 0.001, Infinity, NaN, 0, -1]);
  assert.equal(encoded.unit_m, 0.005);
  assert.deepEqual(countsOf(encoded), [200, 1, 1, 0, 65535, 65535, 65535]);
});

test('a range beyond what counts of 5 mm reach makes the unit larger', () => {
  const encoded = encodeRanges(Float32Array.of(655.34, 65.534));
  assert.ok(Math.abs(encoded.unit_m - 0.01) < 1e-8);
  assert.deepEqual(countsOf(encoded), [65534, 6553]);
});
