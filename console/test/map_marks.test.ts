// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { Raster } from '@plumescout/client';
import { GoalKind, LivePlanSchema, MapStatusSchema, PlanSchema, PolygonSchema, RejectedGoal_Reason } from '@plumescout/client/wire';
import { MapMarks } from '../src/map_marks.ts';
import { MapPen } from '../src/map_pen.ts';
import type { Scene } from '../src/scene.ts';
import { View } from '../src/view.ts';
import { RecordedContext, contextOf, styleSheet } from './recorded_canvas.ts';

styleSheet();
const R1 = 'missions/hall/robots/r1';
const raster = new Raster({ columns: 4, rows: 4, resolution_m: 0.5, x_m: 0, y_m: 0 });

// 10 pixels a metre, the origin in the middle of 100 × 100.
function draw(part: Partial<Scene>) {
  const context = new RecordedContext();
  const view = new View();
  Object.assign(view, { scale: 10, width: 100, height: 100 });
  const scene: Scene = { raster, then: null, figures: null, threshold_ppm: 0, status: null, gases: { names: [], looked: '' },
    plans: [], why: null, asksWhy: true, candidate: -1, trails: new Map(), keepOut: [], draft: null, beside: null, homes: [],
    robot: R1, asked: null, sources: [], judged: [], ...part };
  const marks = new MapMarks(contextOf(context), view, new MapPen(contextOf(context), view), scene, () => 'hue');
  return { context, marks };
}

test('squares of an objective have the colours of their verdicts', () => {
  const { context, marks } = draw({ judged: [{ x_m: 1, y_m: 1, size_m: 1, outlook: 'above' }] });
  marks.judged();
  const [{ args, fill }] = context.of('fillRect');
  assert.deepEqual([args, fill], [[55, 35, 10, 10], '--judged-above']);
});

test('areas are dashed and named where names are wanted; every home is a house', () => {
  const keepOut = [create(PolygonSchema, { name: 'spill', vertices: [{ xM: 0, yM: 0 }, { xM: 2, yM: 0 }, { xM: 2, yM: 2 }] })];
  const { context, marks } = draw({ keepOut, homes: [{ xM: -2, yM: 0 }, { xM: 3, yM: 3 }] as never });
  marks.areas(true);
  assert.ok(context.of('stroke').some(({ dash, stroke }) => dash.length > 0 && stroke === '--bad'));
  assert.deepEqual(context.texts(), ['spill']);
  assert.deepEqual(context.of('fillText')[0].args, ['spill', 60, 40]);
  // The tips of both roofs.
  const tips = context.points('lineTo').filter(([x, y]) => [[30, 42], [80, 12]].some(([a, b]) => a === x && b === y));
  assert.equal(tips.length, 2);
  context.clear();
  marks.areas(false);
  assert.deepEqual(context.texts(), []);
});

test('frontiers differ in shape; those that nobody drives to are faint', () => {
  const frontier = (kind: GoalKind, more: object = {}) => ({ kind, cellColumns: [1], cellRows: [2],
    centroid: { xM: 1, yM: 1 }, reachable: true, ...more });
  const of = (...frontiers: object[]) => {
    const { context, marks } = draw({ status: create(MapStatusSchema, { frontiers }) });
    marks.frontiers(raster);
    return context;
  };
  const map = of(frontier(GoalKind.OCCUPANCY_FRONTIER));
  assert.equal(map.of('rect').length, 1);
  assert.deepEqual(map.of('fillRect')[0].args, [55, 35, 5, 5]); // the cell of half a metre in column 1, row 2
  const gas = of(frontier(GoalKind.GAS_FRONTIER));
  assert.equal(gas.of('rect').length, 0);
  assert.equal(gas.of('closePath').length, 1);
  assert.notEqual(gas.of('fillRect')[0].fill, map.of('fillRect')[0].fill);
  const small = of(frontier(GoalKind.GAS_FRONTIER, { tooSmall: true }));
  assert.ok(small.of('fillRect')[0].alpha < gas.of('fillRect')[0].alpha);
  assert.equal(small.of('stroke').length, 0);
});

test('a plan shows what it was chosen from: numbers at goals, crosses at what was left out', () => {
  const position = (xM: number) => ({ goal: { position: { xM, yM: 0 } }, path: [{ xM: 0, yM: 0 }, { xM, yM: 0 }] });
  const plan = create(PlanSchema, { chosenIndex: 0, candidates: [position(1), position(2), position(3)], rejectedGoals: [
    { goal: { position: { xM: -1, yM: 0 } }, reason: RejectedGoal_Reason.CLAIMED },
    { goal: { position: { xM: -2, yM: 0 } }, reason: RejectedGoal_Reason.TOO_SMALL }] });
  const { context, marks } = draw({ candidate: 2 });
  marks.candidates(plan);
  assert.deepEqual(context.points('lineTo'), [[70, 50], [80, 50]]); // but the chosen one
  const dashes = context.of('stroke').map(({ dash }) => dash.length > 0);
  assert.deepEqual(dashes, [true, true, false, false]); // the one that is pointed at is whole
  context.clear();
  marks.goals(plan);
  assert.deepEqual(context.texts(), ['1', '2', '3']);
  assert.equal(context.of('fillText')[0].fill, '--map-rim');
  assert.deepEqual(context.points('moveTo'), [[36, 46], [44, 46]]);
});

test('ways, claimed goals and trails have the colour of their robot', () => {
  const plan = create(LivePlanSchema, { robot: R1, goal: { xM: 2, yM: 0 }, trajectory: { waypoints: [
    { pose: { xM: 0, yM: 0 } }, { pose: { xM: 2, yM: 0 } }] } });
  const short = create(LivePlanSchema, { robot: R1, trajectory: { waypoints: [{ pose: { xM: 0, yM: 0 } }] } });
  const { context, marks } = draw({ plans: [plan, short], trails: new Map([[R1, { points: [[0, 0], [0, 1]] }]]) });
  marks.ways();
  assert.equal(context.of('stroke').at(-1)?.stroke, 'hue');
  assert.deepEqual(context.points('lineTo'), [[70, 50]]);
  context.clear();
  marks.claims();
  assert.deepEqual(context.points('arc'), [[70, 50]]);
  context.clear();
  marks.trails();
  assert.deepEqual(context.points('moveTo', 'lineTo'), [[50, 50], [50, 40]]);
});

test('robots point ahead, as large as they are; who is silent is faint and says so', () => {
  const robots = [{ robot: R1, radiusM: 2, pose: { xM: 0, yM: 0, yawRad: Math.PI / 2 } },
    { robot: 'missions/hall/robots/r2', radiusM: 0.1, pose: { xM: 3, yM: 0, yawRad: 0 }, silent: true },
    { robot: 'missions/hall/robots/r3', radiusM: 0.1 }];
  const { context, marks } = draw({ status: create(MapStatusSchema, { robots }) });
  marks.robots(true);
  assert.deepEqual(context.of('arc').map(({ args }) => args[2]), [20, 7]); // never too small to be seen
  assert.deepEqual(context.points('lineTo'), [[50, 15], [92.25, 50]]);
  assert.deepEqual(context.of('fill').map(({ alpha }) => alpha), [1, 0.5]);
  assert.deepEqual(context.of('stroke').map(({ stroke }) => stroke), ['--map-ink', '--map-rim']);
  assert.deepEqual(context.texts(), ['r1', 'r2 (silent)']);
});

test('an area that is drawn has its corners, and is filled from the third on', () => {
  const draft = (count: number) => ({ outline: () => [{ x_m: 0, y_m: 0 }, { x_m: 1, y_m: 0 }, { x_m: 1, y_m: 1 }].slice(0, count) });
  for (const [count, fills] of [[0, 0], [2, 0], [3, 1]]) {
    const { context, marks } = draw({});
    marks.draft(draft(count) as never);
    assert.equal(context.of('fill').length, fills);
    assert.equal(context.of('arc').length, count);
  }
});

test('a place that was asked about is in the middle of a crosshair', () => {
  const { context, marks } = draw({});
  marks.crosshair({ x_m: 0, y_m: 0 });
  for (const [x, y] of context.points('moveTo', 'lineTo')) assert.ok(x === 50 || y === 50);
});
