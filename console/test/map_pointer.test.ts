// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { AreaDraft } from '../src/area_draft.ts';
import { listenToPointers } from '../src/map_pointer.ts';

// A canvas whose corner is at (100, 50) of the window, and what its map is told.
function pointedMap(draft: AreaDraft | null = null) {
  const told: string[] = [];
  let hovered: [number, number] | null = null;
  const canvas = Object.assign(new EventTarget(), {
    setPointerCapture: () => {}, getBoundingClientRect: () => ({ left: 100, top: 50 }) });
  listenToPointers(canvas as unknown as HTMLCanvasElement, {
    draft: () => draft,
    drawn: () => told.push('drawn'),
    placeAt: (x, y) => ({ x_m: x / 10, y_m: y / 10 }),
    scale: () => 10,
    hover: (at) => {
      hovered = at;
      if (at === null) told.push('left');
    },
    pan: (dx, dy) => told.push(`pan ${dx} ${dy}`),
    zoom: (by, x, y) => told.push(`zoom ${by.toFixed(2)} ${x} ${y}`),
    click: (x, y) => told.push(`click ${x} ${y}`),
  });
  const send = (type: string, x: number, y: number, pointerId = 1, more = {}) =>
    canvas.dispatchEvent(Object.assign(new Event(type), { clientX: x, clientY: y, pointerId, ...more }));
  return { told, send, hovered: () => hovered };
}

test('a pointer that hardly moves clicks, in pixels of the canvas', () => {
  const { told, send } = pointedMap();
  send('pointerdown', 120, 80);
  send('pointermove', 122, 81);
  send('pointerup', 122, 81);
  assert.deepEqual(told, ['click 22 31']);
});

test('what a finger tapped on is told once it is off; a mouse that leaves is at nothing', () => {
  const { send, hovered } = pointedMap();
  const touch = { pointerType: 'touch' };
  send('pointerdown', 120, 80, 1, touch);
  send('pointerup', 120, 80, 1, touch);
  send('pointerleave', 120, 80, 1, touch);
  assert.deepEqual(hovered(), [20, 30]);
  send('pointermove', 130, 80, 2, { pointerType: 'mouse' });
  send('pointerleave', 130, 80, 2, { pointerType: 'mouse' });
  assert.equal(hovered(), null);
});

test('a pointer that moves on pans; one that is not down does not', () => {
  const { told, send } = pointedMap();
  send('pointermove', 110, 60);
  send('pointerdown', 120, 80);
  send('pointermove', 130, 75);
  send('pointerup', 130, 75);
  send('pointerleave', 0, 0);
  assert.deepEqual(told, ['pan 10 -5', 'left']);
});

test('two pointers pinch about their middle', () => {
  const { told, send } = pointedMap();
  send('pointerdown', 100, 50, 1);
  send('pointerdown', 199, 50, 2);
  send('pointermove', 299, 50, 2);
  assert.deepEqual(told, ['zoom 2.00 99.5 0']);
});

test('what is cancelled is no click; the wheel zooms where it is', () => {
  const { told, send } = pointedMap();
  send('pointerdown', 120, 80);
  send('pointercancel', 120, 80);
  send('wheel', 110, 60, 1, { deltaY: 100 });
  assert.deepEqual(told, ['zoom 0.86 10 10']);
});

test('while an area is drawn nothing is clicked', () => {
  const draft = new AreaDraft('rectangle');
  const { told, send } = pointedMap(draft);
  send('pointerdown', 110, 60);
  send('pointermove', 150, 90);
  send('pointerup', 150, 90);
  assert.deepEqual(told, ['drawn', 'drawn', 'drawn']);
  assert.ok(draft.done);
  assert.deepEqual(draft.area()[0], { x_m: 1, y_m: 1 });
  assert.deepEqual(draft.area()[2], { x_m: 5, y_m: 4 });
});
