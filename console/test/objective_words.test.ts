// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { FREE, Raster } from '@plumescout/client';
import { ObjectiveKind, ObjectiveOptionsSchema, ObjectiveVerdict } from '@plumescout/client/wire';
import { askedInWords, outlooksOf, verdictAreas } from '../src/objective_words.ts';

const asked = (kind: ObjectiveKind) => create(ObjectiveOptionsSchema, { kind, thresholdPpm: 10, confidence: 0.95 });

test('what was asked is told with the threshold and how sure it is to be', () => {
  assert.equal(askedInWords(asked(ObjectiveKind.CONFIRM_CLEAN)),
    'confirm that there is nowhere more than 10 ppm, 95 % sure');
  assert.equal(askedInWords(asked(ObjectiveKind.MAP_ABOVE_THRESHOLD)), 'map where there is more than 10 ppm, 95 % sure');
  assert.equal(askedInWords(asked(ObjectiveKind.FIND_SOURCES)), 'find the strongest place, if it is above 10 ppm, 95 % sure');
  assert.equal(askedInWords(asked(ObjectiveKind.COMPLETE_MAP)), 'a complete map');
});

test('verdicts are called by what the mission is for', () => {
  assert.deepEqual(outlooksOf(asked(ObjectiveKind.CONFIRM_CLEAN)).map(([, words]) => words),
    ['below 10 ppm', 'above 10 ppm', 'undecided, measured', 'undecided, not measured']);
  assert.deepEqual(outlooksOf(asked(ObjectiveKind.MAP_ABOVE_THRESHOLD))[0], ['above', 'above 10 ppm']);
  assert.deepEqual(outlooksOf(undefined).map(([outlook]) => outlook), ['undecided', 'unmeasured']);
});

test('areas are of what counts, on the side that the mean lies on', () => {
  const raster = new Raster({ x_m: 0, y_m: 0, resolution_m: 0.5, columns: 3, rows: 2 });
  raster.occupancy.fill(FREE);
  raster.mean_ppm.set([1, 20, 30, 5, 5, NaN]);
  const V = ObjectiveVerdict;
  const verdicts = Uint8Array.of(V.DECIDED, V.DECIDED, V.DECIDED, V.UNDECIDED, V.NOT_MEASURED, V.DOES_NOT_COUNT);
  const areas = verdictAreas(asked(ObjectiveKind.MAP_ABOVE_THRESHOLD), verdicts, raster);
  assert.deepEqual(areas.map(({ name, area_m2, share }) => [name, area_m2, share]), [
    ['above 10 ppm', 0.5, 0.4], ['below 10 ppm', 0.25, 0.2], ['undecided, measured', 0.25, 0.2],
    ['undecided, not measured', 0.25, 0.2]]);
});

test('where nothing counts there is no share', () => {
  const raster = new Raster({ x_m: 0, y_m: 0, resolution_m: 0.5, columns: 1, rows: 1 });
  const areas = verdictAreas(asked(ObjectiveKind.CONFIRM_CLEAN), Uint8Array.of(ObjectiveVerdict.DOES_NOT_COUNT), raster);
  assert.deepEqual(areas.map(({ share }) => share), [0, 0, 0, 0]);
});
