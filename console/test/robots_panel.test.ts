// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { Point2DSchema, RobotSchema } from '@plumescout/client/wire';
import { homesOf, robotsInShort } from '../src/robots_panel.ts';

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

test('homes are those of the robots, each place once, and the one that the mission names', () => {
  const at = (xM: number, yM: number) => create(Point2DSchema, { xM, yM });
  const robots = [create(RobotSchema, { home: at(1, 2) }), create(RobotSchema, {}), create(RobotSchema, { home: at(1, 2) }),
    create(RobotSchema, { home: at(3, 4) })];
  assert.deepEqual(homesOf(robots, undefined).map(({ xM, yM }) => [xM, yM]), [[1, 2], [3, 4]]);
  assert.deepEqual(homesOf([], at(5, 6)).map(({ xM, yM }) => [xM, yM]), [[5, 6]]);
});
