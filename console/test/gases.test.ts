// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { MapStatusSchema } from '@plumescout/client/wire';
import { countersOf, isFirst, ofGas, ofPlans } from '../src/gases.ts';

const two = (looked: string) => ({ names: ['methane', 'ammonia'], looked });

test('where there is one gas, nothing is said of which', () => {
  for (const names of [[], ['methane']]) {
    assert.equal(ofGas({ names, looked: '' }), '');
    assert.equal(ofPlans({ names, looked: '' }), '');
    assert.ok(isFirst({ names, looked: '' }));
  }
});

test('of several, the one that is looked at is named, and the one that plans go by', () => {
  assert.equal(ofGas(two('')), ' of methane');
  assert.equal(ofGas(two('ammonia')), ' of ammonia');
  assert.ok(isFirst(two('methane')) && !isFirst(two('ammonia')));
  assert.match(ofPlans(two('ammonia')), /go by methane/);
});

test('readings are counted gas by gas', () => {
  const status = create(MapStatusSchema, { gasCounters: { readingCount: 9n },
    gases: [{ species: 'methane', gasCounters: { readingCount: 9n } }, { species: 'ammonia', gasCounters: { readingCount: 4n } }] });
  assert.equal(countersOf(status, two(''))?.readingCount, 9n);
  assert.equal(countersOf(status, two('ammonia'))?.readingCount, 4n);
});
