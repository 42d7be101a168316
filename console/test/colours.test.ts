// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CHANGE, GAS, UNCERTAINTY, lightnessOf, roundUp, shareOf, ticksOf } from '../src/colours.ts';

test('lightness is even, so that equal steps look equal without colour', () => {
  for (const [colours, sign] of [[GAS, 1], [UNCERTAINTY, -1]] as const) {
    const whole = lightnessOf(colours[255]) - lightnessOf(colours[0]);
    assert.ok(sign * whole > 0.5);
    for (let i = 0; i + 16 < colours.length; ++i) {
      const step = lightnessOf(colours[i + 16]) - lightnessOf(colours[i]);
      assert.ok(Math.abs(step / whole - 16 / 255) < 0.02, `step ${i}: ${step / whole}`);
    }
  }
});

test('no change is the lightest, and both sides darken alike', () => {
  for (let i = 0; i < 128; ++i) {
    const [less, more] = [lightnessOf(CHANGE[i]), lightnessOf(CHANGE[255 - i])];
    assert.ok(Math.abs(less - more) < 0.03, `${i}: ${less} ${more}`);
    assert.ok(less <= lightnessOf(CHANGE[128]) + 1e-3);
  }
});

test('scales end where they say', () => {
  const linear = { min: 0, max: 50, log: false };
  assert.equal(shareOf(linear, -1), 0);
  assert.equal(shareOf(linear, 25), 0.5);
  assert.equal(shareOf(linear, 70), 1);
  const log = { min: 0.1, max: 1000, log: true };
  assert.equal(shareOf(log, 0), 0);
  assert.ok(Math.abs(shareOf(log, 10) - 0.5) < 1e-12);
  assert.equal(shareOf(log, 1e6), 1);
  assert.deepEqual(ticksOf(linear), [0, 12.5, 25, 37.5, 50]);
  assert.equal(ticksOf(log).length, 5);
});

test('ends of scales are round', () => {
  assert.deepEqual([0.3, 1, 1.1, 4.9, 5, 6, 237].map(roundUp), [0.5, 1, 2, 5, 5, 10, 500]);
  assert.deepEqual([0, -1, NaN, Infinity].map(roundUp), [1, 1, 1, 1]);
});
