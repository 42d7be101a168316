// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { FREE, OCCUPIED, Raster } from '@plumescout/client';
import { View, knownIn } from '../src/view.ts';

function view(): View {
  const view = new View();
  view.width = 400;
  view.height = 300;
  return view;
}

test('north is up', () => {
  const v = view();
  assert.deepEqual(v.toPixel(0, 0), [200, 150]);
  assert.deepEqual(v.toPixel(1, 1), [220, 130]);
  assert.deepEqual(v.toPlace(...v.toPixel(3, -2)), [3, -2]);
});

test('zoom keeps the place under the pointer', () => {
  const v = view();
  const before = v.toPlace(50, 60);
  v.zoom(2, 50, 60);
  const after = v.toPlace(50, 60);
  assert.ok(Math.abs(before[0] - after[0]) < 1e-9 && Math.abs(before[1] - after[1]) < 1e-9);
  for (let i = 0; i < 40; ++i) v.zoom(2);
  assert.ok(v.scale < 1e4);
});

test('fit shows all of the box', () => {
  const v = view();
  for (const box of [{ minX: -5, minY: 0, maxX: 15, maxY: 4 }, { minX: 0, minY: 0, maxX: 1, maxY: 9 }]) {
    v.fit(box, 50);
    for (const [x, y] of [v.toPixel(box.minX, box.minY), v.toPixel(box.maxX, box.maxY)]) {
      assert.ok(x >= 0 && x <= 400 && y >= 50 && y <= 300);
    }
  }
});

test('fit keeps clear of what covers the corner, and loses as little as that takes', () => {
  const v = view();
  const corner = { width: 150, height: 100 };
  const shown = (box: Parameters<typeof v.fit>[0]) => {
    v.fit(box, 50, corner);
    return { corner: v.toPixel(box.minX, box.minY), scale: v.scale };
  };
  const high = { minX: 0, minY: 0, maxX: 4, maxY: 9 }; // beside it
  assert.ok(shown(high).corner[0] >= corner.width);
  v.fit(high, 50);
  assert.equal(shown(high).scale, v.scale);
  const flat = { minX: 0, minY: 0, maxX: 9, maxY: 2 }; // above it, where it would be anyway
  assert.ok(shown(flat).corner[1] <= 300 - corner.height);
  const large = shown({ minX: 0, minY: 0, maxX: 9, maxY: 6 });
  assert.ok(large.corner[0] >= corner.width || large.corner[1] <= 300 - corner.height);
});

test('what is known grows by what has changed', () => {
  const raster = new Raster({ x_m: 0, y_m: 0, resolution_m: 1, columns: 6, rows: 5 });
  const rect = (fromColumn: number, fromRow: number, toColumn: number, toRow: number) => ({ fromColumn, fromRow, toColumn, toRow });
  const all = rect(0, 0, 6, 5);
  assert.equal(knownIn(raster, all, null), null);
  raster.occupancy[1 * 6 + 2] = FREE;
  raster.occupancy[2 * 6 + 3] = OCCUPIED;
  const before = knownIn(raster, all, null);
  assert.deepEqual(before, rect(2, 1, 4, 3));
  raster.occupancy[4 * 6 + 5] = FREE;
  assert.deepEqual(knownIn(raster, rect(0, 0, 3, 3), before), before);
  assert.deepEqual(knownIn(raster, rect(4, 4, 6, 5), before), rect(2, 1, 6, 5));
});
