// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import test from 'node:test';
import { AreaDraft, freeName } from '../src/area_draft.ts';

const at = (x_m: number, y_m: number) => ({ x_m, y_m });
const NEAR = 0.1;
const click = (draft: AreaDraft, x_m: number, y_m: number) => {
  draft.press(at(x_m, y_m));
  draft.release(at(x_m, y_m), false, NEAR);
};

test('a rectangle is dragged', () => {
  const draft = new AreaDraft('rectangle');
  assert.ok(draft.drags);
  assert.deepEqual(draft.area(), []);
  draft.press(at(3, 2));
  draft.move(at(1, 5));
  assert.deepEqual(draft.outline(), [at(3, 2), at(1, 2), at(1, 5), at(3, 5)]);
  assert.ok(!draft.done);
  draft.release(at(1, 4), true, NEAR);
  assert.ok(draft.done);
  draft.move(at(9, 9)); // the pointer goes elsewhere
  assert.deepEqual(draft.area(), [at(3, 2), at(1, 2), at(1, 4), at(3, 4)]);
  draft.press(at(0, 0)); // and begins anew
  assert.ok(!draft.done);
  assert.deepEqual(draft.area(), []);
});

test('a rectangle is clicked by two corners', () => {
  const draft = new AreaDraft('rectangle');
  click(draft, 0, 0);
  assert.ok(!draft.done);
  draft.move(at(0.05, 3));
  draft.release(at(0.05, 3), false, NEAR);
  assert.ok(!draft.done, 'too flat to be meant');
  click(draft, 2, 1);
  assert.deepEqual(draft.area(), [at(0, 0), at(2, 0), at(2, 1), at(0, 1)]);
  assert.ok(draft.done);
});

test('a polygon ends on its first corner', () => {
  const draft = new AreaDraft('polygon');
  assert.ok(!draft.drags);
  click(draft, 0, 0);
  click(draft, 2, 0);
  click(draft, 0.05, 0); // two corners are no area yet
  assert.equal(draft.area().length, 3);
  draft.undo();
  click(draft, 2, 2);
  draft.move(at(1, 2));
  assert.equal(draft.outline().length, 4);
  assert.equal(draft.area().length, 3);
  draft.release(at(8, 8), true, NEAR); // the map was dragged
  assert.equal(draft.area().length, 3);
  click(draft, 0.05, 0.05);
  assert.ok(draft.done);
  assert.deepEqual(draft.area(), [at(0, 0), at(2, 0), at(2, 2)]);
  click(draft, 5, 5);
  assert.equal(draft.area().length, 3, 'it has ended');
  draft.undo();
  assert.ok(!draft.done);
  click(draft, 0, 2);
  assert.equal(draft.area().length, 4);
});

test('an area has as many corners as the server takes', () => {
  const draft = new AreaDraft('polygon');
  for (let i = 0; i < 300; ++i) click(draft, i, i % 2);
  assert.equal(draft.area().length, 256);
  assert.ok(draft.done);
});

test('new areas have names that are free', () => {
  assert.equal(freeName([]), 'area-1');
  assert.equal(freeName(['area-1', 'ramp', 'area-3']), 'area-2');
});
