// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { FREE, OCCUPIED, Raster } from '@plumescout/client';
import { CellPicture, scaleOf } from '../src/cell_picture.ts';
import type { Cells } from '../src/cell_picture.ts';
import { CHANGE, GAS, UNCERTAINTY } from '../src/colours.ts';
import { styleSheet } from './recorded_canvas.ts';
import type { recordedCanvas } from './recorded_canvas.ts';

const cells = (max_ppm: number, p99_stddev_ppm: number, beside: Cells | null = null): Cells => ({
  raster: null, then: null, threshold_ppm: 0.2, beside,
  figures: { known_m2: 1, free_m2: 1, plume_m2: 0, max_ppm, max_stddev_ppm: 500, p99_stddev_ppm, mean_entropy_nats: 0 } });

test('a map alone is on its own scale', () => {
  assert.deepEqual(scaleOf('mean', false, cells(18, 3), null), { min: 0, max: 20, log: false });
  assert.deepEqual(scaleOf('uncertainty', false, cells(18, 3), null), { min: 0, max: 5, log: false });
});

test('maps beside each other are on one scale, that of the larger', () => {
  const [low, high] = [cells(18, 3), cells(45, 8)];
  [low.beside, high.beside] = [high, low];
  for (const layer of ['mean', 'uncertainty'] as const) {
    assert.deepEqual(scaleOf(layer, false, low, null), scaleOf(layer, false, high, null));
  }
  assert.equal(scaleOf('mean', true, low, null).max, 50);
  assert.equal(scaleOf('uncertainty', false, low, null).max, 10);
});

const [FREE_COLOUR, WALL_COLOUR] = [[255, 255, 255, 255], [16, 32, 48, 255]];
styleSheet({ '--map-free': '#ffffff', '--map-wall': '#102030' });

// Two by two: a wall and free ground in the south, free ground with gas and nothing known in the north.
function painted() {
  const raster = new Raster({ columns: 2, rows: 2, resolution_m: 1, x_m: 0, y_m: 0 });
  raster.occupancy.set([OCCUPIED, FREE, FREE, 0]);
  raster.mean_ppm.set([NaN, NaN, 10, NaN]);
  raster.variance_ppm2.set([NaN, NaN, 4, NaN]);
  const shown = { ...cells(10, 2), raster };
  const picture = new CellPicture(() => shown);
  picture.log = false;
  const context = (picture.canvas as unknown as ReturnType<typeof recordedCanvas>).context;
  const pixel = (column: number, row: number) => {
    const { data } = context.of('putImageData').at(-1)!.args[0] as ImageData;
    return [...data.slice(4 * (2 * row + column), 4 * (2 * row + column) + 4)];
  };
  return { picture, raster, shown, context, pixel };
}

test('cells have their colours, north up, and what is unknown is seen through', () => {
  const { picture, pixel } = painted();
  picture.prepare();
  assert.deepEqual(pixel(0, 1), WALL_COLOUR);
  assert.deepEqual(pixel(1, 1), FREE_COLOUR);
  assert.deepEqual(pixel(0, 0), [...GAS[255], 255]); // the upper end of the scale
  assert.deepEqual(pixel(1, 0), [0, 0, 0, 0]);
});

test('uncertainty is a standard deviation, and without a layer free ground is bare', () => {
  const { picture, pixel } = painted();
  picture.layer = 'uncertainty';
  picture.prepare();
  assert.deepEqual(picture.scale, { min: 0, max: 2, log: false });
  assert.deepEqual(pixel(0, 0), [...UNCERTAINTY[255], 255]);
  picture.layer = 'none';
  picture.forget();
  picture.prepare();
  assert.deepEqual(pixel(0, 0), FREE_COLOUR);
});

test('the change is of the mean since then', () => {
  const { picture, raster, shown, pixel } = painted();
  shown.then = raster.copy();
  raster.mean_ppm[2] = 30;
  picture.layer = 'change';
  picture.prepare();
  assert.deepEqual(picture.scale, { min: -20, max: 20, log: false });
  assert.deepEqual(pixel(0, 0), [...CHANGE[255], 255]);
});

test('of cells that change only these are put on the canvas, unless the scale moves', () => {
  const { picture, raster, shown, context, pixel } = painted();
  picture.prepare();
  raster.mean_ppm[2] = 0;
  const rect = { fromColumn: 0, fromRow: 1, toColumn: 1, toRow: 2 };
  picture.update([rect]);
  assert.deepEqual(context.of('putImageData').at(-1)!.args.slice(1), [0, 0, 0, 0, 1, 1]);
  assert.deepEqual(pixel(0, 0), [...GAS[0], 255]);
  const before = context.of('putImageData').length;
  shown.figures!.max_ppm = 90;
  picture.update([rect]);
  assert.equal(context.of('putImageData').length, before); // all of it is painted when it is drawn
  picture.prepare();
  assert.deepEqual(context.of('putImageData').at(-1)!.args.slice(1), [0, 0, 0, 0, 2, 2]);
});
