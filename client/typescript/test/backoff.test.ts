// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Backoff, pause } from '../src/backoff.ts';

const OPTIONS = { first_s: 1, longest_s: 3, factor: 2, jitter: 0.25 };

test('waits grow up to the longest, and begin again', () => {
  const backoff = new Backoff(OPTIONS, () => 0.5); // the middle of the spread
  assert.deepEqual([1, 2, 3, 4].map(() => backoff.next_s()), [1, 2, 3, 3]);
  backoff.reset();
  assert.equal(backoff.next_s(), 1);
});

test('waits are spread on both sides, and never longer than the longest', () => {
  assert.equal(new Backoff(OPTIONS, () => 0).next_s(), 0.75);
  assert.equal(new Backoff(OPTIONS, () => 1).next_s(), 1.25);
  const late = new Backoff({ ...OPTIONS, first_s: 3 }, () => 1);
  assert.equal(late.next_s(), 3);
});

test('a pause ends with its signal', async () => {
  await pause(1e6, AbortSignal.abort());
  const abort = new AbortController();
  const paused = pause(1e6, abort.signal);
  abort.abort();
  await paused;
});
