// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { FrontierGoalSchema } from '@plumescout/client/wire';

// What the panel does without a page; imported once there is a little of one.
async function why() {
  Object.assign(globalThis, { location: { origin: 'http://localhost' }, sessionStorage: { getItem: () => null } });
  return import('../src/why_panel.ts');
}

const at = (xM: number, yM: number) => ({ xM, yM });
const frontier = (goal: object) => create(FrontierGoalSchema, { goal });

test('a click means the nearest frontier: its middle, or where a robot would stand', async () => {
  const { nearestFrontier } = await why();
  const [far, near] = [frontier({ centroid: at(0, 0), position: at(2, 0) }), frontier({ centroid: at(3, 0.1) })];
  const all = [frontier({}), far, near];
  assert.equal(nearestFrontier(all, { x_m: 0.3, y_m: 0 }), far);
  assert.equal(nearestFrontier(all, { x_m: 2.3, y_m: 0 }), far);
  assert.equal(nearestFrontier(all, { x_m: 2.7, y_m: 0 }), near);
});

test('a click that is far from all of them means the place itself', async () => {
  const { nearestFrontier } = await why();
  const [one] = [frontier({ centroid: at(0, 0) })];
  assert.equal(nearestFrontier([one], { x_m: 0.79, y_m: 0 }), one);
  assert.equal(nearestFrontier([one], { x_m: 0.81, y_m: 0 }), null);
  assert.equal(nearestFrontier([], { x_m: 0, y_m: 0 }), null);
});
