// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { test } from 'node:test';
import { importMission } from '../src/import_mission.ts';
import { crc32, exportMission } from '../src/mission_file.ts';
import { SnapshotService, SystemService } from '../src/wire/index.ts';
import type { ImportMissionRequest } from '../src/wire/index.ts';
import { clientOf } from './support.ts';

const FILE = new TextEncoder().encode('123456789');

test('crc32 is that of zlib', () => {
  assert.equal(crc32(FILE), 0xcbf43926);
  assert.equal(crc32(FILE.subarray(4), crc32(FILE.subarray(0, 4))), 0xcbf43926);
});

// An export of FILE in two pieces, of which the second is `second` and which ends after so many.
function exporting(second: Uint8Array, total: bigint | null) {
  return clientOf(({ service }) => service(SnapshotService, {
    async* exportMission() {
      yield { part: { case: 'start' as const, value: { expectedBytes: 20n } } };
      const first = FILE.slice(0, 4);
      yield { part: { case: 'piece' as const, value: { data: first, crc32: crc32(first) } } };
      yield { part: { case: 'piece' as const, value: { offsetBytes: 4n, data: second, crc32: crc32(FILE) } } };
      if (total !== null) yield { part: { case: 'end' as const, value: { totalBytes: total } } };
    },
  }));
}

async function saved(client: ReturnType<typeof exporting>): Promise<string> {
  let text = '';
  for await (const { data } of exportMission(client, 'missions/hall')) text += new TextDecoder().decode(data);
  return text;
}

test('an export is whole, or thrown', async () => {
  assert.equal(await saved(exporting(FILE.slice(4), 9n)), '123456789');
  await assert.rejects(saved(exporting(FILE.slice(3, 8), 9n)), /the piece at byte 4 is not what was sent/);
  await assert.rejects(saved(exporting(FILE.slice(4), 10n)), /of 10 bytes, 9 came/);
  await assert.rejects(saved(exporting(FILE.slice(4), null)), /ends after 9 bytes/);
});

test('an import comes in pieces that the server takes, each with what was sent so far', async () => {
  const parts: ImportMissionRequest['part'][] = [];
  const client = clientOf(({ service }) => {
    service(SystemService, { getServerInfo: () => ({ limits: { maxReceiveBytes: 4096 + 4 } }) });
    service(SnapshotService, { importMission: async (requests) => {
      for await (const { part } of requests) parts.push(part);
      return { mission: { name: 'missions/copy' } };
    } });
  });
  const mission = await importMission(client, [FILE.subarray(0, 6), FILE.subarray(6)], { missionId: 'copy' });
  assert.equal(mission.name, 'missions/copy');
  assert.deepEqual(parts.map((part) => (part.case === 'piece' ? Buffer.from(part.value.data).toString() : part.case)),
                   ['start', '1234', '56', '789', 'end']);
  const last = parts.at(-2)!, end = parts.at(-1)!;
  assert.ok(last.case === 'piece' && last.value.offsetBytes === 6n && last.value.crc32 === 0xcbf43926);
  assert.ok(end.case === 'end' && end.value.totalBytes === 9n);
  assert.deepEqual(Buffer.from(end.value.sha256), createHash('sha256').update(FILE).digest());
});
