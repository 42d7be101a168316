// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { planOf } from '../src/plan.ts';
import { MissionPhase, PlanSchema } from '../src/wire/index.ts';

test('plans are arrays, one number a waypoint', () => {
  const plan = planOf(create(PlanSchema, {
    name: 'missions/hall/plans/3', explanation: 'the nearest frontier',
    trajectory: { lengthM: 2, durationS: 9, waypoints: [
      { pose: { xM: 1, yM: 2, yawRad: 0.5 }, speedMps: 0.25 },
      { pose: { xM: 3, yM: 2, yawRad: 0.75 }, arrivalTimeS: 4, dwellS: 5 },
    ] },
  }));
  assert.deepEqual(plan.x_m, Float64Array.of(1, 3));
  assert.deepEqual(plan.y_m, Float64Array.of(2, 2));
  assert.deepEqual(plan.yaw_rad, Float64Array.of(0.5, 0.75));
  assert.deepEqual(plan.arrival_s, Float64Array.of(0, 4));
  assert.deepEqual(plan.dwell_s, Float64Array.of(0, 5));
  assert.deepEqual(plan.speed_mps, Float64Array.of(0.25, 0));
  assert.deepEqual([plan.name, plan.complete, plan.length_m, plan.duration_s], ['missions/hall/plans/3', false, 2, 9]);
});

test('a plan to stay has no waypoints', () => {
  const plan = planOf(create(PlanSchema, { phase: MissionPhase.COMPLETE, chosenIndex: -1 }));
  assert.equal(plan.x_m.length, 0);
  assert.ok(plan.complete);
});
