// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A mission as MCAP, as an independent reader has it, with all its checksums.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { McapIndexedReader, McapStreamReader } from '@mcap/core';
import { decompress } from 'fzstd';

const FILE = '../tests/formats/view/golden/room.mcap';
const decompressHandlers = {
  zstd: (packed: Uint8Array, size: bigint) => decompress(packed, new Uint8Array(Number(size))),
};

test('a stream reader finds every message and no wrong checksum', () => {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(readFileSync(FILE));
  const topics = new Map<number, string>();
  const counts = new Map<string, number>();
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    if (record.type === 'Channel') topics.set(record.id, record.topic);
    if (record.type !== 'Message') continue;
    const topic = topics.get(record.channelId);
    assert.ok(topic);
    counts.set(topic, (counts.get(topic) ?? 0) + 1);
  }
  assert.ok(reader.done());
  assert.equal(counts.get('/journal'), 35);  // the start and 34 events
  assert.equal(counts.get('/plans'), 1);
  assert.equal(counts.get('/map/occupancy'), 2);
});

test('its index leads to the messages of a topic and time', async () => {
  const bytes = readFileSync(FILE);
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset: bigint, size: bigint) =>
      new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const schemas = [...reader.schemasById.values()].map((schema) => schema.name);
  for (const name of ['foxglove.Grid', 'foxglove.LaserScan', 'foxglove.Log',
                      'foxglove.PoseInFrame', 'foxglove.SceneUpdate', 'plumescout.v1.Plan']) {
    assert.ok(schemas.includes(name), name);
  }
  const times: bigint[] = [];
  const wish = { topics: ['/robots/scout/pose'], startTime: 1_000_000_000n };
  for await (const message of reader.readMessages(wish)) times.push(message.logTime);
  assert.ok(times.length > 0 && times.every((time) => time >= 1_000_000_000n));
});
