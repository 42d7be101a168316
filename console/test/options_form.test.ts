// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { pointsOf } from '../src/options_form.ts';

test('corners are read, and what is none is named', () => {
  assert.deepEqual(pointsOf(' 1,2  -3.5,4 ', 'area'), [{ xM: 1, yM: 2 }, { xM: -3.5, yM: 4 }]);
  assert.throws(() => pointsOf('1,2 3', 'area'), /area: “3” is not x,y/);
  assert.throws(() => pointsOf('1,2,3', 'area'), /“1,2,3”/);
});
