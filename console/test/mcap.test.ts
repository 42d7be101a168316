// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// MCAP files of before, as an independent reader has them: of a mission (room), of a mission while it ran on a
// server (live), and of a robot in it (scout). How they came about: ../tests/formats/view/golden/README.md.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { openIndexed, readStream, readWhole } from './mcap_file.mjs';

const DRAWN = ['foxglove.LaserScan', 'foxglove.Log', 'foxglove.PoseInFrame', 'foxglove.SceneUpdate',
               'plumescout.v1.Observation', 'plumescout.v1.Plan'];
const FILES = {
  room: {
    path: '../tests/formats/view/golden/room.mcap',
    counts: { '/journal': 35, '/plans': 1, '/map/occupancy': 2 },  // the start and 34 events
    schemas: [...DRAWN, 'foxglove.Grid'],
  },
  live: {
    path: '../tests/formats/view/golden/live.mcap',
    counts: { '/journal': 196, '/plans': 2, '/map/occupancy': 2 },
    schemas: [...DRAWN, 'foxglove.Grid'],
  },
  scout: {
    path: '../tests/formats/view/golden/scout.mcap',
    counts: { '/registration': 1, '/observations': 92, '/plans': 2 },
    schemas: [...DRAWN, 'plumescout.v1.RegisterRobotRequest'],
  },
};

for (const [name, { path, counts, schemas }] of Object.entries(FILES)) {
  test(`of ${name} every message is found, also by the index, and no checksum is wrong`, async () => {
    const read = await readWhole(readFileSync(path));
    for (const [topic, count] of Object.entries(counts)) assert.equal(read.counts.get(topic), count, topic);
    for (const schema of schemas) assert.ok(read.schemas.has(schema), schema);
  });
}

test('its index leads to the messages of a topic and time', async () => {
  const reader = await openIndexed(readFileSync(FILES.room.path));
  const times: bigint[] = [];
  const wish = { topics: ['/robots/scout/pose'], startTime: 1_000_000_000n };
  for await (const message of reader.readMessages(wish)) times.push(message.logTime);
  assert.ok(times.length > 0 && times.every((time) => time >= 1_000_000_000n));
});

test('a file that was cut off is read up to the last whole chunk; a wrong byte is found', () => {
  const bytes = readFileSync(FILES.room.path);
  assert.equal(readStream(bytes.subarray(0, bytes.length - 100)).isWhole, false);
  const wrong = Uint8Array.from(bytes);
  wrong[wrong.length / 2 | 0] ^= 1;
  assert.throws(() => readStream(wrong));
});
