// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { base64Of, bytesOf, fillReport } from '../src/reported_mission.ts';
import type { ReportedMission } from '../src/reported_mission.ts';

const MISSION: ReportedMission = { title: '</script>', map: 'AQ==', plans: [], ways: [], homes_m: [], sources_m: [], objective: null };

test('a mission stands in the page, and nothing of it ends the script', () => {
  const page = fillReport('<script>@mission@</script><script>x</script>', MISSION);
  const text = /^<script>(.*?)<\/script><script>x<\/script>$/.exec(page)?.[1] ?? '';
  assert.deepEqual(JSON.parse(text), MISSION);
});

test('a page without a place for a mission is no page for reports', () => {
  assert.throws(() => fillReport('<p>another page</p>', MISSION), /no page for reports/);
});

test('bytes come through base64, however many they are', () => {
  const bytes = new Uint8Array(100_000).map((_, i) => i % 251);
  assert.deepEqual(bytesOf(base64Of(bytes)), bytes);
  assert.equal(base64Of(new Uint8Array(0)), '');
});
