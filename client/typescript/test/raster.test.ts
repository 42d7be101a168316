// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { create } from '@bufbuild/protobuf';
import { FREE, OCCUPIED, Raster, changeOf, figuresOf } from '../src/raster.ts';
import { MapLayer, MapTileSchema, MapTile_Encoding } from '../src/wire/index.ts';

const geometry = { x_m: -1, y_m: 2, resolution_m: 0.5, columns: 4, rows: 3 };

function tile(layer: MapLayer, encoding: MapTile_Encoding, column: number, row: number,
              columns: number, cells: ArrayBufferView) {
  const data = new Uint8Array(cells.buffer, cells.byteOffset, cells.byteLength);
  const size = encoding === MapTile_Encoding.U8 ? 1 : encoding === MapTile_Encoding.F32 ? 4 : 2;
  return create(MapTileSchema, {
    layer, encoding, minCell: { column, row }, columnCount: columns,
    rowCount: data.length / size / columns, valueScale: 0.5, valueOffset: 10,
    deflatedData: new Uint8Array(deflateSync(data)),
  });
}

test('tiles land where they belong', () => {
  const raster = new Raster(geometry);
  const rect = raster.apply(tile(MapLayer.OCCUPANCY, MapTile_Encoding.U8, 1, 1, 2,
                                 Uint8Array.of(FREE, OCCUPIED, FREE, FREE)));
  assert.deepEqual(rect, { fromColumn: 1, fromRow: 1, toColumn: 3, toRow: 3 });
  assert.deepEqual([...raster.occupancy], [0, 0, 0, 0, 0, 1, 2, 0, 0, 1, 1, 0]);
  raster.apply(tile(MapLayer.GAS_MEAN, MapTile_Encoding.U16_SCALED, 1, 1, 1,
                    Uint16Array.of(4, 65535)));
  assert.equal(raster.mean_ppm[5], 12);
  assert.ok(Number.isNaN(raster.mean_ppm[9]));
  raster.apply(tile(MapLayer.GAS_VARIANCE, MapTile_Encoding.F32, 1, 1, 1, Float32Array.of(4, 0.25)));
  assert.equal(raster.variance_ppm2[5], 4);
  assert.equal(raster.variance_ppm2[9], 0.25);
});

test('tiles beyond the map are refused', () => {
  const raster = new Raster(geometry);
  assert.throws(() => raster.apply(tile(MapLayer.OCCUPANCY, MapTile_Encoding.U8, 3, 0, 2,
                                        Uint8Array.of(1, 1))), /beyond the map/);
});

test('places have cells', () => {
  const raster = new Raster(geometry);
  assert.equal(raster.cellAt(-1, 2), 0);
  assert.equal(raster.cellAt(0.99, 3.49), 11);
  assert.equal(raster.cellAt(1, 2), -1);
  assert.equal(raster.cellAt(-1.01, 2), -1);
});

test('figures count what is known', () => {
  const raster = new Raster(geometry);
  raster.occupancy.set([FREE, FREE, OCCUPIED]);
  raster.mean_ppm.set([3, 8]);
  raster.variance_ppm2.set([1, 4]);
  const figures = figuresOf(raster, 5);
  assert.equal(figures.known_m2, 0.75);
  assert.equal(figures.free_m2, 0.5);
  assert.equal(figures.plume_m2, 0.25);
  assert.equal(figures.max_ppm, 8);
  assert.equal(figures.max_stddev_ppm, 2);
  const standard = 0.5 * Math.log(2 * Math.PI * Math.E);
  assert.ok(Math.abs(figures.mean_entropy_nats - (standard + 0.25 * Math.log(4))) < 1e-12);
  assert.equal(figures.p99_stddev_ppm, 2);
  assert.ok(Number.isNaN(figuresOf(new Raster(geometry), 5).max_ppm));
});

test('a cell in a hundred does not say how large deviations are', () => {
  const many = new Raster({ ...geometry, columns: 40, rows: 5 });
  many.occupancy.fill(FREE);
  many.mean_ppm.fill(1);
  many.variance_ppm2.fill(9);
  many.variance_ppm2[7] = 250_000;
  const { max_stddev_ppm, p99_stddev_ppm } = figuresOf(many, 5);
  assert.equal(max_stddev_ppm, 500);
  assert.ok(p99_stddev_ppm >= 3 && p99_stddev_ppm < 3.5, String(p99_stddev_ppm));
});

test('changes are found though the map has grown', () => {
  const then = new Raster(geometry);
  then.mean_ppm.set([1, 2]);
  const now = new Raster({ ...geometry, x_m: -1.5, columns: 5 });
  now.mean_ppm.set([7, 4, 4]);
  const change = changeOf(now, then);
  assert.ok(Number.isNaN(change[0]));
  assert.equal(change[1], 3);
  assert.equal(change[2], 2);
});
