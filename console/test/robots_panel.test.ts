// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { RobotSchema } from '@plumescout/client/wire';
import { robotsInShort } from '../src/robots_panel.ts';

const robot = (name: string, silent: boolean, ages: object = {}) =>
  create(RobotSchema, { onMap: { robot: `missions/hall/robots/${name}`, silent }, ...ages });

test('robots are told in short by who is silent and by the oldest of each', () => {
  assert.deepEqual(robotsInShort([robot('one', false, { lastHeardAgeS: 0.2, ingestLagS: 3 }),
    robot('two', true, { lastHeardAgeS: 60, ingestLagS: 1 }), robot('three', true)]),
  ['3', 'two, three', '60 s', '3 s']);
});

test('of robots that were never heard there is no age', () => {
  assert.deepEqual(robotsInShort([robot('one', false)]), ['1', 'none', '–', '–']);
  assert.deepEqual(robotsInShort([]), ['0', 'none', '–', '–']);
});
