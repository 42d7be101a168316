// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { create } from '@bufbuild/protobuf';
import { MapCopy, levelFor } from '../src/map_copy.ts';
import {
  MapLayer, MapTileSchema, MapTile_Encoding, WatchMapResponseSchema, WatchMapResponse_Kind as Kind,
} from '../src/wire/index.ts';

function frame(kind: Kind, base: bigint, revision: bigint, cells: number[], columns = 2) {
  return create(WatchMapResponseSchema, {
    kind, baseRevision: base, revision,
    tileGeometry: { origin: { xM: 0, yM: 0 }, resolutionM: 0.1, columnCount: columns, rowCount: 1 },
    tiles: cells.length === 0 ? [] : [create(MapTileSchema, {
      layer: MapLayer.OCCUPANCY, encoding: MapTile_Encoding.U8, minCell: { column: 0, row: 0 },
      columnCount: cells.length, rowCount: 1,
      deflatedData: new Uint8Array(deflateSync(Uint8Array.from(cells))),
    })],
  });
}

test('frames build the map up', () => {
  const copy = new MapCopy();
  assert.equal(copy.apply(frame(Kind.FULL, 0n, 3n, [1, 2])), 'all');
  assert.deepEqual([...copy.raster!.occupancy], [1, 2]);
  assert.deepEqual(copy.apply(frame(Kind.DELTA, 3n, 5n, [2])),
                   [{ fromColumn: 0, fromRow: 0, toColumn: 1, toRow: 1 }]);
  assert.deepEqual([...copy.raster!.occupancy], [2, 2]);
  assert.deepEqual(copy.apply(frame(Kind.PROGRESS, 5n, 6n, [])), []);
  assert.equal(copy.revision, 6n);
});

test('a frame that does not fit is an error, so that the stream begins again', () => {
  const copy = new MapCopy();
  assert.throws(() => copy.apply(frame(Kind.DELTA, 0n, 1n, [1])), /not here/);
  copy.apply(frame(Kind.FULL, 0n, 3n, [1, 2]));
  assert.throws(() => copy.apply(frame(Kind.DELTA, 2n, 5n, [1])), /not here/);
  assert.throws(() => copy.apply(frame(Kind.DELTA, 3n, 5n, [1], 4)), /not here/);
  copy.apply(frame(Kind.RESET, 3n, 4n, []));
  assert.equal(copy.raster, null);
  assert.throws(() => copy.apply(frame(Kind.DELTA, 3n, 5n, [1])), /not here/);
});

test('a map without cells is none', () => {
  const copy = new MapCopy();
  assert.equal(copy.apply(frame(Kind.FULL, 0n, 0n, [], 0)), 'all');
  assert.equal(copy.raster, null);
});

test('large maps are shown in squares', () => {
  assert.equal(levelFor(0), 0);
  assert.equal(levelFor(4_000_000), 0);
  assert.equal(levelFor(4_000_001), 1);
  assert.equal(levelFor(400_000_000), 4);
});
