// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { ObjectiveStatusSchema, ObjectiveStatus_State } from '@plumescout/client/wire';
import { linkWords, objectiveWords } from '../src/words.ts';

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

test('a link is told by what it shows', () => {
  assert.deepEqual(linkWords('live', false, 0), ['live', 'pill good']);
  assert.deepEqual(linkWords('live', true, 0), ['playing', 'pill warn']);
  assert.deepEqual(linkWords('waiting', false, 2), ['connection lost, again in 2 s', 'pill bad']);
  assert.deepEqual(linkWords('ended', true, 0), ['ended', 'pill bad']);
});
