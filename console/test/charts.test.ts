// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Series, drawChart, spanOf } from '../src/charts.ts';
import { recordedCanvas, styleSheet } from './recorded_canvas.ts';
import { bytes, duration, figure } from '../src/words.ts';

test('long series are thinned and keep their ends', () => {
  const series = new Series(100);
  for (let i = 0; i < 10_000; ++i) series.add(i, i);
  assert.ok(series.samples.length < 100 && series.samples.length > 30);
  assert.equal(series.samples[0].t_s, 0);
  assert.ok(series.last > 9_000);
  const steps = series.samples.slice(1).map((sample, i) => sample.t_s - series.samples[i].t_s);
  assert.ok(Math.max(...steps) <= 2 * Math.min(...steps));
});

test('what is no number is left out', () => {
  const series = new Series();
  series.add(0, NaN);
  assert.equal(series.samples.length, 0);
  assert.ok(Number.isNaN(series.last));
});

test('figures are short', () => {
  assert.deepEqual([0, 0.05678, 12.345, 999.9, 12345, 3e7, 0.0001, NaN].map((value) => figure(value)),
                   ['0', '0.0568', '12.3', '1000', '12345', '3.0e+7', '1.0e-4', '–']);
  assert.deepEqual([12, 2048, 3 << 20, 5 * 2 ** 30].map(bytes), ['12 B', '2 kiB', '3 MiB', '5 GiB']);
  assert.deepEqual([0.05, 5, 300, 8000].map(duration), ['50 ms', '5 s', '5 min 0 s', '2 h 13 min']);
});

function chartOf(unit: string, ...lines: [number, number][][]) {
  styleSheet();
  const canvas = recordedCanvas(300, 100);
  drawChart(canvas as never, lines.map((line, i) => ({ name: `r${i}`, colour: `hue ${i}`,
    samples: line.map(([t_s, value]) => ({ t_s, value })) })), unit);
  return canvas;
}

test('a chart goes from its left to its right, from the least value to the largest', () => {
  const { context, width } = chartOf('ppm', [[10, 0], [20, 8], [30, 4]]);
  assert.equal(width, 600); // of two pixels each
  assert.deepEqual(context.of('scale')[0].args, [2, 2]);
  const line = context.strokes.filter(({ stroke, call }) => stroke === 'hue 0' && /To$/.test(call)).map(({ args }) => args);
  assert.deepEqual(line, [[44, 84], [169, 6], [294, 45]]);
  assert.deepEqual(context.texts(), ['0', '4', '8', 'ppm', 'last 20 s']);
});

test('lines of a chart share its axes, and shares go up to the whole', () => {
  const { context } = chartOf('%', [[0, 20], [600, 40]], [[0, 50], [300, 50]]);
  const ends = ['hue 0', 'hue 1'].map((hue) => context.strokes.filter(({ stroke }) => stroke === hue).findLast(({ call }) => call === 'lineTo')!.args);
  assert.deepEqual(ends, [[294, 52.8], [169, 45]]);
  assert.deepEqual(context.texts(), ['0', '50', '100', '%', 'last 10 min']);
});

test('one value is no line, and a line that does not move has one', () => {
  assert.deepEqual(chartOf('m²', [[3, 1]]).context.texts(), ['waiting for a second value']);
  const { context } = chartOf('m²', [[0, 0], [1, 0]]);
  assert.deepEqual(context.points('moveTo').at(-1), [44, 84]);
});

test('charts of the same time have one axis, whenever their lines begin', () => {
  const late = [{ name: '', colour: 'hue 0', samples: [{ t_s: 30, value: 1 }, { t_s: 40, value: 2 }] }];
  const early = [{ name: '', colour: 'hue 1', samples: [{ t_s: 0, value: 1 }, { t_s: 35, value: 2 }] }];
  const span = spanOf([...late, ...early, { name: '', colour: '', samples: [] }]);
  assert.deepEqual(span, { from_s: 0, to_s: 40 });
  styleSheet();
  const canvas = recordedCanvas(300, 100);
  drawChart(canvas as never, late, 'm²', span);
  const line = canvas.context.strokes.filter(({ stroke, call }) => stroke === 'hue 0' && /To$/.test(call)).map(({ args }) => args[0]);
  assert.deepEqual(line, [231.5, 294]);
  assert.ok(canvas.context.texts().includes('last 40 s'));
});
