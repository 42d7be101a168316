// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { MissionClock } from '../src/mission_clock.ts';
import type { HistoryRequest } from '../src/mission_clock.ts';

// Refreshes at these revisions, each a second after the one before.
function clockOf(numbers: bigint[], asked: HistoryRequest[] = []) {
  return new MissionClock(async (request) => {
    asked.push(request);
    const from = request.pageToken === '' ? request.firstNumber : BigInt(request.pageToken);
    const all = numbers.map((number, i) => ({ number, sampleTimeNs: 7_000_000_000n + BigInt(i) * 1_000_000_000n }))
      .filter(({ number }) => number >= from);
    return { events: all.slice(0, request.pageSize), nextPageToken: String(all[request.pageSize]?.number ?? '') };
  });
}
const settle = async () => { for (let i = 0; i < 20; ++i) await new Promise(setImmediate); };

test('a revision has a time between those of the refreshes about it, the last ones that of the last', async () => {
  const clock = clockOf([10n, 20n, 30n]);
  assert.equal(await clock.elapsed_s(1n), 0);
  assert.equal(await clock.elapsed_s(15n), 0.5);
  assert.equal(await clock.elapsed_s(20n), 1);
  assert.equal(await clock.elapsed_s(35n), 2);
});

test('however long ago the last refresh was, it is found, and then known', async () => {
  const asked: HistoryRequest[] = [];
  const clock = clockOf([10n, 20n], asked);
  assert.equal(await clock.elapsed_s(1_000_000n), 1);
  const before = asked.length;
  assert.equal(await clock.elapsed_s(1_000_100n), 1);
  assert.ok(asked.slice(before).every(({ firstNumber }) => firstNumber >= 20n), 'nothing is read again before it');
  assert.equal(await clock.elapsed_s(15n), 0.5);
});

test('of refreshes that are pages apart the last before is meant', async () => {
  const clock = clockOf(Array.from({ length: 3000 }, (_, i) => BigInt(i + 1)));
  assert.equal(await clock.elapsed_s(5000n), 2999);
});

test('a mission that has no time yet has none', async () => {
  assert.equal(await clockOf([]).elapsed_s(3n), null);
});

test('pages without such an event are passed', async () => {
  let pages = 0;
  const clock = new MissionClock(async ({ pageToken }) => {
    ++pages;
    return pageToken === '' ? { events: [], nextPageToken: 'on' }
      : { events: [{ number: 900n, sampleTimeNs: 4n }], nextPageToken: '' };
  });
  assert.equal(await clock.elapsed_s(0n), 0);
  assert.equal(pages, 2);
});

test('of many questions at once the first and the last are answered', async () => {
  const told: (number | null)[] = [];
  const asked: HistoryRequest[] = [];
  const clock = clockOf([10n, 20n, 30n, 40n], asked);
  for (const revision of [5n, 15n, 25n, 35n]) clock.tell(revision, (elapsed_s) => told.push(elapsed_s));
  await settle();
  assert.deepEqual(told, [0, 2.5]);
  assert.equal(asked.length, 3); // the beginning, and both ends of what lies about the last
});

test('where the history is refused the time is not known, and is asked for again', async () => {
  let refuses = true;
  const clock = new MissionClock(async () => {
    if (refuses) throw new Error('not now');
    return { events: [{ number: 1n, sampleTimeNs: 5n }], nextPageToken: '' };
  });
  const told: (number | null)[] = [];
  clock.tell(1n, (elapsed_s) => told.push(elapsed_s));
  await settle();
  assert.ok(told.length === 1 && told[0] === null);
  refuses = false;
  clock.tell(1n, (elapsed_s) => told.push(elapsed_s));
  await settle();
  assert.deepEqual(told, [null, 0]);
});
