// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { addressOf, hashOf } from '../src/address.ts';

test('an address leads back to what it was made of', () => {
  for (const address of [{ path: 'missions/hall', revision: null, gas: '' },
    { path: 'missions/hall', revision: 120n, gas: '' }, { path: 'missions/hall', revision: null, gas: 'methane' },
    { path: 'missions/hall', revision: 0n, gas: 'hydrogen-sulfide' }]) {
    assert.deepEqual(addressOf(hashOf(address)), address);
  }
  assert.equal(hashOf({ path: 'missions/hall', revision: 120n, gas: 'methane' }), '#/missions/hall@120?gas=methane');
});

test('what is typed by hand is read as far as it goes', () => {
  assert.deepEqual(addressOf(''), { path: '', revision: null, gas: '' });
  assert.deepEqual(addressOf('#/missions/hall@1x2?colour=red'), { path: 'missions/hall', revision: 12n, gas: '' });
});
