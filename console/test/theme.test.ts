// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { theme } from '../src/theme.ts';

test('colours are looked up once a theme, and one that is not there yet again', () => {
  const dataset = { theme: 'light' };
  const sheet: Record<string, Record<string, string>> = {
    light: { '--map-free': ' #ffffff' }, dark: { '--map-free': ' #3a474e' } };
  let lookups = 0;
  Object.assign(globalThis, { document: { documentElement: { dataset } }, getComputedStyle: () => ({
    getPropertyValue: (name: string) => {
      ++lookups;
      return sheet[dataset.theme][name] ?? '';
    } }) });
  assert.deepEqual([theme('--map-free'), theme('--map-free'), lookups], ['#ffffff', '#ffffff', 1]);
  dataset.theme = 'dark';
  assert.deepEqual([theme('--map-free'), lookups], ['#3a474e', 2]);
  assert.equal(theme('--map-wall'), ''); // the style sheet is on its way
  sheet.dark['--map-wall'] = '#b9c6cd';
  assert.equal(theme('--map-wall'), '#b9c6cd');
});
