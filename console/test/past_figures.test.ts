// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { Raster } from '@plumescout/client';
import type { MapUpdate } from '@plumescout/client';
import { MapStatusSchema } from '@plumescout/client/wire';

Object.assign(globalThis, { location: { origin: 'http://localhost' }, sessionStorage: { getItem: () => null } });
const { pastFigures, speedOf } = await import('../src/past_figures.ts');

const raster = new Raster({ columns: 2, rows: 1, resolution_m: 1, x_m: 0, y_m: 0 });
const frame = (revision: bigint, known: Raster | null = raster): MapUpdate =>
  ({ raster: known, status: create(MapStatusSchema, {}), revision, changed: 'all' });

test('frames before the page was opened become figures, at the times of the mission', async () => {
  async function* updates() {
    yield frame(1n, null); // there was no map yet
    yield frame(5n);
    yield frame(9n);
    yield frame(20n);
    assert.fail('nobody reads on');
  }
  const found = [];
  const clock = { elapsed_s: async (revision: bigint) => (revision === 5n ? null : Number(revision) / 2) };
  for await (const one of pastFigures(updates(), 20n, { names: [], looked: '' }, clock)) found.push(one);
  assert.deepEqual(found.map(({ t_s }) => t_s), [4.5]);
  assert.ok(found[0].figures.some(({ title }) => title === 'Known area'));
});

test('a long mission is shown faster', () => {
  assert.equal(speedOf(60), 60);
  assert.equal(speedOf(36_000), 3_600);
});
