// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { Code, ConnectError } from '@connectrpc/connect';
import { MissionFiguresSchema } from '@plumescout/client/wire';
import { pastFigures } from '../src/past_figures.ts';
import type { Ask } from '../src/past_figures.ts';

const moments = (count: number) => Array.from({ length: count }, (_, i) => create(MissionFiguresSchema, { revision: BigInt(i) }));
const refusal = new ConnectError('no room', Code.ResourceExhausted);

// What comes of answers, and how long is waited before each but the first.
async function read(ask: Ask, signal = new AbortController().signal) {
  const waits_s: number[] = [], found: number[] = [];
  let error: unknown = null;
  try {
    for await (const figures of pastFigures(ask, signal, async (wait_s) => { waits_s.push(wait_s); })) found.push(figures.length);
  } catch (thrown) {
    error = thrown;
  }
  return { waits_s, found, error };
}

test('figures are asked for until they are whole', async () => {
  const counts = [0, 3, 7];
  const ask = async () => ({ figures: moments(counts.shift()!), moreFollow: counts.length > 0 });
  assert.deepEqual(await read(ask), { waits_s: [1, 1], found: [0, 3, 7], error: null });
});

test('a server without room is left alone for longer and longer, and then altogether', async () => {
  const { waits_s, found, error } = await read(async () => { throw refusal; });
  assert.deepEqual(waits_s, [1, 2, 4, 8, 15]);
  assert.deepEqual([found, error], [[], refusal]);
});

test('attempts that come to nothing between refusals do not make it endless', async () => {
  let asked = 0;
  const { error } = await read(async () => {
    if (++asked % 2 === 0) throw refusal;
    return { figures: [], moreFollow: true };
  });
  assert.equal(error, refusal);
  assert.equal(asked, 12);
});

test('what does not pass by itself is not tried again', async () => {
  const none = new ConnectError('this server keeps no journal', Code.FailedPrecondition);
  assert.deepEqual(await read(async () => { throw none; }), { waits_s: [], found: [], error: none });
});

test('a page that is left asks no more', async () => {
  const abort = new AbortController();
  const { found } = await read(async () => {
    abort.abort();
    return { figures: moments(1), moreFollow: true };
  }, abort.signal);
  assert.deepEqual(found, []);
});
