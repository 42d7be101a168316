// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// MCAP files as an independent reader has them, @mcap/core, with all their checksums.
import assert from 'node:assert/strict';
import { McapIndexedReader, McapStreamReader } from '@mcap/core';
import { decompress } from 'fzstd';

const decompressHandlers = {
  zstd: (packed, size) => decompress(packed, new Uint8Array(Number(size))),
};

// From the front: how many messages each topic has, and whether the file has an end.
export function readStream(bytes) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(bytes);
  const topics = new Map(), counts = new Map();
  let last = 0n;
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    if (record.type === 'Channel') topics.set(record.id, record.topic);
    if (record.type !== 'Message') continue;
    assert.ok(record.logTime >= last, `${topics.get(record.channelId)} goes back to ${record.logTime}`);
    last = record.logTime;
    const topic = topics.get(record.channelId);
    assert.ok(topic, `channel ${record.channelId} is one`);
    counts.set(topic, (counts.get(topic) ?? 0) + 1);
  }
  return { counts, isWhole: reader.done() };
}

// By the index at its end.
export function openIndexed(bytes) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
  };
  return McapIndexedReader.Initialize({ readable, decompressHandlers });
}

// A file with an end, whose index leads to all that stands in it; counts as of readStream, and the names
// of its schemas.
export async function readWhole(bytes) {
  const { counts, isWhole } = readStream(bytes);
  assert.ok(isWhole, 'the file has an end');
  const reader = await openIndexed(bytes);
  const indexed = new Map();
  for await (const { channelId } of reader.readMessages()) {
    const { topic } = reader.channelsById.get(channelId);
    indexed.set(topic, (indexed.get(topic) ?? 0) + 1);
  }
  assert.deepEqual(Object.fromEntries([...indexed].sort()), Object.fromEntries([...counts].sort()));
  return { counts, schemas: new Set([...reader.schemasById.values()].map(({ name }) => name)) };
}
