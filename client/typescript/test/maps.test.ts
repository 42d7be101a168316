// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { Code } from '@connectrpc/connect';
import type { MessageInitShape } from '@bufbuild/protobuf';
import { getMap, watchMap } from '../src/maps.ts';
import type { MapUpdate, WatchMapOptions } from '../src/maps.ts';
import {
  MapLayer, MapService, MapTile_Encoding, WatchMapResponse_Kind as Kind,
} from '../src/wire/index.ts';
import type { WatchMapRequest, WatchMapResponseSchema } from '../src/wire/index.ts';
import { Timers, clientOf, refusal } from './support.ts';

type Frame = MessageInitShape<typeof WatchMapResponseSchema>;

const timers = new Timers();
const GEOMETRY = { origin: { xM: 1, yM: 2 }, resolutionM: 0.1, columnCount: 2, rowCount: 1 };
const STATUS = { geometry: GEOMETRY };
const tileOf = (column: number, cells: number[]) => ({
  layer: MapLayer.OCCUPANCY, encoding: MapTile_Encoding.U8, minCell: { column, row: 0 },
  columnCount: cells.length, rowCount: 1, deflatedData: new Uint8Array(deflateSync(Uint8Array.from(cells))),
});
const FULL: Frame = { kind: Kind.FULL, revision: 3n, status: STATUS, tiles: [tileOf(0, [1, 2])] };
const DELTA: Frame = { kind: Kind.DELTA, baseRevision: 3n, revision: 5n, status: STATUS, tiles: [tileOf(1, [1])] };

// A client whose n-th stream gives the n-th list, then fails, or stays open if there is no error.
function serving(...streams: { frames: Frame[]; error?: Error }[]) {
  const requests: WatchMapRequest[] = [];
  const signals: AbortSignal[] = [];
  const client = clientOf(({ service }) => service(MapService, {
    async* watchMap(request, { signal }) {
      const { frames, error } = streams[requests.length]!;
      requests.push(request);
      signals.push(signal);
      yield* frames;
      if (error !== undefined) throw error;
      await new Promise((done) => { signal.addEventListener('abort', done); });
    },
  }));
  return { client, requests, signals };
}

// Reads so many updates, and notes what the link did.
async function read(client: ReturnType<typeof serving>['client'], count: number, options: WatchMapOptions = {}) {
  const states: string[] = [];
  const updates: (Pick<MapUpdate, 'revision' | 'changed'> & { cells: number[] })[] = [];
  const watch = watchMap(client, 'missions/hall', { ...options, onLink: (state) => { states.push(state); } });
  for await (const { raster, revision, changed } of watch) {
    updates.push({ revision, changed, cells: [...raster?.occupancy ?? []] });
    if (updates.length === count) break;
  }
  return { states, updates };
}

test('a map comes in parts, and once more if its parts are gone', async () => {
  const tokens: string[] = [];
  const client = clientOf(({ service }) => service(MapService, {
    getMap: ({ partToken }) => {
      tokens.push(partToken);
      if (tokens.length === 2) throw refusal(Code.Aborted, 'MAP_PARTS_GONE');
      return partToken === ''
        ? { revision: 7n, status: STATUS, tileGeometry: GEOMETRY, tiles: [tileOf(0, [1])], nextPartToken: 'b' }
        : { revision: 7n, tiles: [tileOf(1, [2])] };
    },
  }));
  const { raster, revision } = await getMap(client, 'missions/hall');
  assert.equal(revision, 7n);
  assert.deepEqual([...raster!.occupancy], [1, 2]);
  assert.deepEqual(tokens, ['', 'b', '', 'b']);
});

test('a mission without a map has no raster', async () => {
  const client = clientOf(({ service }) => service(MapService, { getMap: () => ({ status: {} }) }));
  assert.equal((await getMap(client, 'missions/hall')).raster, null);
});

test('updates are of whole revisions', async () => {
  const { client, signals } = serving({ frames: [
    { ...FULL, tiles: [tileOf(0, [1])], moreFollow: true },
    { kind: Kind.DELTA, baseRevision: 3n, revision: 3n, tiles: [tileOf(1, [2])] }, DELTA] });
  const { updates, states } = await read(client, 2);
  assert.deepEqual(updates, [
    { revision: 3n, changed: 'all', cells: [1, 2] },
    { revision: 5n, changed: [{ fromColumn: 1, fromRow: 0, toColumn: 2, toRow: 1 }], cells: [1, 1] },
  ]);
  assert.deepEqual(states, ['connecting', 'live']);
  assert.ok(signals[0]!.aborted); // the reader has left
});

test('a link that breaks is opened again', async () => {
  const { client } = serving({ frames: [FULL], error: refusal(Code.Unavailable) }, { frames: [FULL, DELTA] });
  const reading = read(client, 3);
  await timers.pass(600); // half a second, spread by a fifth
  const { updates, states } = await reading;
  assert.deepEqual(updates.map(({ changed }) => changed === 'all'), [true, true, false]);
  assert.deepEqual(states, ['connecting', 'live', 'waiting', 'connecting', 'live']);
});

test('a change of a map that is not here begins the stream again', async () => {
  const { client, requests } = serving({ frames: [DELTA] }, { frames: [FULL] });
  const reading = read(client, 1);
  await timers.pass(600);
  assert.equal((await reading).updates[0]!.revision, 3n);
  assert.equal(requests.length, 2);
});

test('what cannot pass by itself is thrown; a signal ends the watch without a word', async () => {
  await assert.rejects(read(serving({ frames: [FULL], error: refusal(Code.NotFound) }).client, 2), /as asked for/);
  const abort = new AbortController();
  const { client } = serving({ frames: [FULL] });
  let updates = 0;
  for await (const _ of watchMap(client, 'missions/hall', { signal: abort.signal })) {
    ++updates;
    abort.abort();
  }
  assert.equal(updates, 1);
});

test('what a callback throws is thrown, and asks nobody again', async () => {
  for (const state of ['connecting', 'live']) {
    const { client, requests } = serving({ frames: [FULL, FULL] });
    const watching = (async () => {
      const onLink = (now: string) => { if (now === state) throw new Error('mine'); };
      for await (const _ of watchMap(client, 'missions/hall', { onLink })) continue;
    })();
    await assert.rejects(watching, /mine/);
    assert.equal(requests.length, state === 'live' ? 1 : 0);
  }
});

test('of maps that are too large, squares are asked for', async () => {
  const { client, requests } = serving({ frames: [FULL] }, { frames: [FULL] });
  await read(client, 1, { maxCells: 1 });
  assert.deepEqual(requests.map(({ levelOfDetail }) => levelOfDetail), [0, 1]);
});

test('a replay goes on where it was, and live if the server has lost that', async () => {
  const { client, requests } = serving({ frames: [FULL], error: refusal(Code.Unavailable) },
                                       { frames: [], error: refusal(Code.OutOfRange) }, { frames: [FULL] });
  const reading = read(client, 2, { fromRevision: 1n, speedRatio: 5 });
  await timers.pass(600);
  await timers.pass(1200);
  await reading;
  assert.deepEqual(requests.map(({ fromRevision }) => fromRevision), [1n, 3n, undefined]);
  assert.equal(requests[0]!.speedRatio, 5);
});
