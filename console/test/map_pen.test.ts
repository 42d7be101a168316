// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { MapPen } from '../src/map_pen.ts';
import { View } from '../src/view.ts';
import { RecordedContext, contextOf, styleSheet } from './recorded_canvas.ts';

styleSheet();

// 10 pixels a metre, the origin in the middle of 100 × 100.
function pen() {
  const context = new RecordedContext();
  const view = new View();
  Object.assign(view, { scale: 10, width: 100, height: 100 });
  return { context, pen: new MapPen(contextOf(context), view) };
}

test('a path goes through its places, north up', () => {
  const { context, pen: drawn } = pen();
  drawn.path([{ xM: 0, yM: 0 }, { xM: 1, yM: 2 }, { xM: -1, yM: 0 }]);
  assert.equal(context.strokes[0].call, 'beginPath');
  assert.deepEqual(context.points('moveTo'), [[50, 50]]);
  assert.deepEqual(context.points('lineTo'), [[60, 30], [40, 50]]);
});

test('a line is seen on any ground: a rim that is wider lies below its colour', () => {
  const { context, pen: drawn } = pen();
  drawn.strokeTwice('red', 2, 3);
  assert.deepEqual(context.of('stroke').map(({ stroke, width }) => [stroke, width]), [['--map-rim', 5], ['red', 2]]);
});

test('the grid is of whole metres, and lies on half pixels', () => {
  const { context, pen: drawn } = pen();
  drawn.grid();
  const columns = context.points('moveTo').filter(([, y]) => y === 0).map(([x]) => x);
  assert.deepEqual(columns, [0.5, 50.5]); // every 5 m
  const rows = context.points('moveTo').filter(([x, y]) => x === 0 && y !== 0).map(([, y]) => y);
  assert.deepEqual(rows, [100.5, 50.5]);
});

test('the bar is as long as it says', () => {
  const { context, pen: drawn } = pen();
  drawn.scaleBar();
  const [, from, to] = [...context.points('moveTo'), ...context.points('lineTo')];
  assert.deepEqual(context.texts(), ['10 m']);
  assert.equal(to[0] - from[0], 100);
});

test('words have a rim, and numbers stand in their circle', () => {
  const { context, pen: drawn } = pen();
  drawn.label('spill', 3, 4, 'left', 'middle');
  assert.deepEqual(context.strokes.map(({ call, args }) => [call, ...args]),
                   [['strokeText', 'spill', 3, 4], ['fillText', 'spill', 3, 4]]);
  context.clear();
  drawn.disc({ xM: 1, yM: 1 } as never, '2', true);
  assert.deepEqual(context.points('arc'), [[60, 40]]);
  assert.equal(context.of('fill')[0].fill, '--map-ink');
  assert.equal(context.of('fillText')[0].fill, '--map-rim');
  context.clear();
  drawn.cross({ x_m: -1, y_m: 0 }, 'red', 4);
  assert.deepEqual(context.points('moveTo', 'lineTo'), [[36, 46], [44, 54], [44, 46], [36, 54]]);
});
