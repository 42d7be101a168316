// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { View } from '../src/view.ts';

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
