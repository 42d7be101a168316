// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { inflate } from '../src/inflate.ts';

function noise(size: number): Uint8Array {
  let state = 1;
  return Uint8Array.from({ length: size }, () => {
    state = (Math.imul(state, 1103515245) + 12345) >>> 0;
    return state >>> 24;
  });
}

test('what zlib deflates comes back', () => {
  const samples = [new Uint8Array(1), new Uint8Array(8192), noise(1), noise(70_000),
    Uint8Array.from({ length: 8192 }, (_, i) => (i / 64) % 3)];
  for (const sample of samples) {
    for (const level of [0, 1, 6, 9]) {
      const data = deflateSync(sample, { level });
      assert.deepEqual(inflate(data, sample.length), sample);
    }
    const fixed = deflateSync(sample, { strategy: 4 });
    assert.deepEqual(inflate(fixed, sample.length), sample);
  }
});

test('what is not the data that was promised is refused', () => {
  const data = deflateSync(noise(1000));
  assert.throws(() => inflate(data, 999), /too long/);
  assert.throws(() => inflate(data, 1001), /too short/);
  assert.throws(() => inflate(data.subarray(0, 500), 1000));
  assert.throws(() => inflate(new Uint8Array(100), 10), /no zlib/);
});

test('no bytes make it hang or read beyond its end', () => {
  const data = deflateSync(Uint8Array.from({ length: 5000 }, (_, i) => i % 251));
  for (let i = 2; i < data.length; ++i) {
    const broken = Uint8Array.from(data);
    broken[i] ^= 0x55;
    try {
      assert.equal(inflate(broken, 5000).length, 5000);
    } catch (error) {
      assert.ok(error instanceof Error);
    }
  }
});
