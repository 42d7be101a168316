// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import test from 'node:test';
import { checkMapFiles } from '../src/options_form.ts';

test('files of another format are told apart', () => {
  checkMapFiles('resolution: 0.1\nimage: hall.pgm\n', 'P5\n');
  assert.throws(() => checkMapFiles('<html>', 'P5\n'), /names no image/);
  assert.throws(() => checkMapFiles('image: hall.png', '\x89PN'), /not a binary PGM/);
});
