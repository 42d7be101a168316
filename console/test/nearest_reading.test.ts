// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { beforeEach, test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { QueryGasResponseSchema } from '@plumescout/client/wire';
import type { QueryGasResponse } from '@plumescout/client/wire';
import type { Place } from '../src/area_draft.ts';
import { NearestReading, nearestInWords } from '../src/nearest_reading.ts';

const SECOND_NS = 1_000_000_000n;

function answer(nearestReadingM?: number, age_s?: number): QueryGasResponse {
  const sampleTimeNs = 1000n * SECOND_NS;
  const nearestReadingTimeNs = age_s === undefined ? undefined : sampleTimeNs - BigInt(age_s) * SECOND_NS;
  return create(QueryGasResponseSchema, { sampleTimeNs, gas: [{ nearestReadingM, nearestReadingTimeNs }] });
}

test('distance and age are told in words', () => {
  assert.equal(nearestInWords(answer(1.23, 34)), 'nearest reading 1.2 m away, 34 s ago');
  assert.equal(nearestInWords(answer(0.04, 0)), 'nearest reading 0.0 m away, just now');
  assert.equal(nearestInWords(answer(7, 600)), 'nearest reading 7.0 m away, 10 min 0 s ago');
  assert.equal(nearestInWords(answer(2)), 'nearest reading 2.0 m away', 'of before times were kept');
  assert.equal(nearestInWords(answer()), '', 'none yet');
});

// Timers that are run by hand.
const timers = new Map<number, () => void>();
let lastTimer = 0;
Object.assign(globalThis, {
  setTimeout: (task: () => void) => {
    timers.set(++lastTimer, task);
    return lastTimer;
  },
  clearTimeout: (timer: number) => { timers.delete(timer); },
});
async function runTimers(): Promise<void> {
  const due = [...timers.values()];
  timers.clear();
  for (const task of due) task();
  for (let i = 0; i < 10; ++i) await Promise.resolve();
}

const asked: Place[] = [];
let goesOn = true;
let told = 0;
let reply = async (): Promise<QueryGasResponse | null> => answer(1, asked.length);
const make = () => new NearestReading({
  ask: (place) => {
    asked.push(place);
    return reply();
  },
  goesOn: () => goesOn,
}, () => { ++told; });

beforeEach(() => {
  timers.clear();
  asked.length = 0;
  goesOn = true;
  told = 0;
  reply = async () => answer(1, asked.length);
});

test('only where the pointer rests is asked, and again while it does', async () => {
  const nearest = make();
  nearest.move({ x_m: 1, y_m: 1 });
  nearest.move({ x_m: 2, y_m: 1 });
  assert.equal(timers.size, 1);
  await runTimers();
  assert.deepEqual(asked, [{ x_m: 2, y_m: 1 }]);
  assert.match(nearest.text, /1 s ago/);
  await runTimers();
  assert.match(nearest.text, /2 s ago/);
  assert.equal(told, 2);
  nearest.move(null);
  assert.equal(nearest.text, '');
  assert.equal(timers.size, 0);
});

test('the past is asked once', async () => {
  goesOn = false;
  const nearest = make();
  nearest.move({ x_m: 1, y_m: 1 });
  await runTimers();
  assert.equal(timers.size, 0);
  assert.match(nearest.text, /nearest/);
});

test('an answer that comes late is not told of another place', async () => {
  let finish = (_: QueryGasResponse) => {};
  reply = () => new Promise((resolve) => { finish = resolve; });
  const nearest = make();
  nearest.move({ x_m: 1, y_m: 1 });
  await runTimers();
  nearest.move({ x_m: 2, y_m: 1 });
  finish(answer(1, 7));
  await Promise.resolve();
  assert.equal(nearest.text, '');
  assert.equal(told, 0);
});

test('a refusal leaves the place without an answer, until the next', async () => {
  reply = async () => { throw new Error('no'); };
  const nearest = make();
  nearest.move({ x_m: 1, y_m: 1 });
  await runTimers();
  assert.equal(nearest.text, '');
  reply = async () => answer(1, 5);
  await runTimers();
  assert.match(nearest.text, /5 s ago/);
});
