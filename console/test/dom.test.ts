// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { tabOfKey } from '../src/dom.ts';

test('arrows lead from tab to tab and around, others nowhere', () => {
  assert.equal(tabOfKey('ArrowRight', 0, 4), 1);
  assert.equal(tabOfKey('ArrowRight', 3, 4), 0);
  assert.equal(tabOfKey('ArrowLeft', 0, 4), 3);
  assert.equal(tabOfKey('Home', 2, 4), 0);
  assert.equal(tabOfKey('End', 1, 4), 3);
  assert.equal(tabOfKey('Enter', 1, 4), null);
});
