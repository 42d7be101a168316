// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Series } from '../src/charts.ts';
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
