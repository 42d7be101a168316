// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { ObjectiveStatusSchema, ObjectiveStatus_State, StoreInfoSchema } from '@plumescout/client/wire';
import {
  linkWords, noPlanWords, objectiveWords, robotsAsOf, squaresInWords, storeFacts,
} from '../src/words.ts';

test('an objective is told in a few words', () => {
  const words = (state: ObjectiveStatus_State) =>
    objectiveWords(create(ObjectiveStatusSchema, { state, confidence: 0.975, undecidedAreaM2: 12.34 }));
  assert.deepEqual(words(ObjectiveStatus_State.MET), ['objective met, 97.5 %', 'pill good']);
  assert.deepEqual(words(ObjectiveStatus_State.REFUTED), ['objective refuted, 97.5 %', 'pill bad']);
  assert.deepEqual(words(ObjectiveStatus_State.CANNOT_BE_MET), ['objective not met', 'pill warn']);
  assert.deepEqual(words(ObjectiveStatus_State.PURSUED), ['objective: 12.3 m² undecided', 'pill']);
});

test('of a complete map there is nothing to tell', () => {
  assert.deepEqual(objectiveWords(undefined), ['', '']);
});

test('that there is no plan is told of now alone', () => {
  const robot = 'missions/hall/robots/robot-1';
  assert.equal(noPlanWords(robot, true, true), 'robot-1 has not been given a plan since the server started.');
  assert.equal(noPlanWords(robot, true, false), 'Asking the server …');
  assert.equal(noPlanWords('', true, true), 'No robot yet.');
  assert.match(noPlanWords(robot, false, true), /^Plans are told of now alone/);
});

test('squares of cells are told, cells are not', () => {
  assert.equal(squaresInWords(0.1, 0.1), '');
  assert.equal(squaresInWords(0.4, 0.1), 'squares of 4 × 4 cells');
  assert.equal(squaresInWords(0.4, NaN), '');
});

test('robots are told with what they are of, if that is not now and this map', () => {
  assert.equal(robotsAsOf(true, true), '');
  assert.equal(robotsAsOf(false, true), 'Robots as they are now:');
  for (const isLive of [true, false]) {
    assert.equal(robotsAsOf(isLive, false), 'Robots as the server last told of them:');
  }
});

test('a link is told by what it shows', () => {
  assert.deepEqual(linkWords('live', false, 0), ['live', 'pill good']);
  assert.deepEqual(linkWords('live', true, 0), ['playing', 'pill warn']);
  assert.deepEqual(linkWords('waiting', false, 0.535), ['connection lost, again in 1 s', 'pill bad']);
  assert.deepEqual(linkWords('waiting', false, 0), ['connection lost', 'pill bad']);
  assert.deepEqual(linkWords('ended', true, 0), ['ended', 'pill bad']);
});

test('a store is told by what a restart would find', () => {
  const facts = (store: object) => storeFacts(create(StoreInfoSchema, store)).map(([, fact]) => fact);
  assert.deepEqual(storeFacts(undefined), [['kept', 'not told by this server']]);
  assert.match(facts({ engine: 'none' })[0], /gone when the server ends/);
  assert.deepEqual(facts({ engine: 'sqlite', available: true, storedBytes: 2_097_152n }),
                   ['in files of the server (SQLite)', 'takes data', '2 MiB', '0 B']);
  assert.deepEqual(
    facts({ engine: 'postgresql', node: 'one', cluster: 'yard', trouble: 'no room', backlogBytes: 7n }),
    ['in a database (postgresql)', 'one of yard', 'takes no data now: no room', 'not counted yet', '7 B']);
});
