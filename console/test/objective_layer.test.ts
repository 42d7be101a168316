// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { FREE, OCCUPIED, Raster } from '@plumescout/client';
import { GasAtPointSchema, ObjectiveOptionsSchema, ObjectiveVerdict, QueryGasResponseSchema } from '@plumescout/client/wire';
import { ObjectiveLayer, judgedSquares, spread, squaresOf } from '../src/objective_layer.ts';

function room(columns: number, rows: number): Raster {
  const raster = new Raster({ x_m: 10, y_m: 0, resolution_m: 0.5, columns, rows });
  raster.occupancy.fill(FREE);
  return raster;
}
const point = (verdict: ObjectiveVerdict, meanPpm?: number) => create(GasAtPointSchema, { verdict, meanPpm });

test('a small map is judged cell by cell, where it is free', () => {
  const raster = room(3, 1);
  raster.occupancy[1] = OCCUPIED;
  assert.deepEqual(squaresOf(raster), { size_m: 0.5, places: [{ x_m: 10.25, y_m: 0.25 }, { x_m: 11.25, y_m: 0.25 }] });
});

test('of a large map squares are judged by their middle, as many as are answered for', () => {
  const { places, size_m } = squaresOf(room(90, 90), 900);
  assert.equal(places.length, 900);
  assert.equal(size_m, 1.5);
  assert.deepEqual(places[0], { x_m: 10.75, y_m: 0.75 });
});

test('what is said of a square is said of its cells', () => {
  const raster = room(5, 3);
  const { places, size_m } = squaresOf(raster, 6);
  assert.equal(size_m, 1);
  assert.deepEqual([...spread(raster, places, size_m, places.map((_, i) => i + 1))], [1, 1, 2, 2, 0, 1, 1, 2, 2, 0, 0, 0, 0, 0, 0]);
});

test('verdicts become what is drawn, and what does not count is left out', () => {
  const V = ObjectiveVerdict;
  const gas = [point(V.DECIDED, 1), point(V.DECIDED, 9), point(V.REFUTED, 9), point(V.UNDECIDED, 5),
    point(V.NOT_MEASURED), point(V.DOES_NOT_COUNT), point(V.UNSPECIFIED)];
  const places = gas.map((_, i) => ({ x_m: i, y_m: 0 }));
  assert.deepEqual(judgedSquares(places, 0.1, gas, 5).map(({ x_m, outlook }) => [x_m, outlook]),
    [[0, 'below'], [1, 'above'], [2, 'refuted'], [3, 'undecided'], [4, 'unmeasured']]);
});

test('it is asked for while it is shown, and what comes late is dropped', async () => {
  const answers: ((verdict: ObjectiveVerdict) => void)[] = [];
  let changes = 0;
  const layer = new ObjectiveLayer({
    ask: () => new Promise((resolve) => answers.push((verdict) =>
      resolve(create(QueryGasResponseSchema, { gas: [point(verdict)] })))),
    goesOn: () => false, asked: () => create(ObjectiveOptionsSchema, { thresholdPpm: 5 }), mostPlaces: 9 }, () => room(1, 1), () => ++changes);
  layer.show(true);
  layer.show(true); // of another moment
  answers[0](ObjectiveVerdict.NOT_MEASURED);
  answers[1](ObjectiveVerdict.UNDECIDED);
  await new Promise((done) => setTimeout(done));
  assert.equal(changes, 1);
  assert.deepEqual(layer.squares.map(({ outlook }) => outlook), ['undecided']);
  layer.show(false);
  assert.deepEqual(layer.squares, []);
  assert.equal(answers.length, 2);
});
