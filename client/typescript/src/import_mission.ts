// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import { createHash } from 'node:crypto';
import type { MessageInitShape } from '@bufbuild/protobuf';
import { maxRequestBytes } from './client.ts';
import type { Client } from './client.ts';
import { crc32 } from './mission_file.ts';
import type { ImportMissionRequestSchema, Mission } from './wire/index.ts';

const MAX_PIECE_BYTES = 1 << 20;
const FRAMING_BYTES = 4096; // of a request, beside the bytes of the file

/** Makes a mission of a file's bytes, which come in pieces of any size (fs.createReadStream). missionId:
 * of the new mission; empty: that of the mission in the file. Errors are those of ImportMission. */
export async function importMission(client: Client, file: AsyncIterable<Uint8Array> | Iterable<Uint8Array>,
                                    options: { missionId?: string; signal?: AbortSignal } = {}): Promise<Mission> {
  const pieceBytes = Math.max(1, Math.min(MAX_PIECE_BYTES, await maxRequestBytes(client) - FRAMING_BYTES));
  const { missionId = '', ...call } = options;
  const { mission } = await client.snapshots.importMission(requests(file, missionId, pieceBytes), call);
  if (mission === undefined) throw new Error('the server named no mission');
  return mission;
}

async function* requests(file: AsyncIterable<Uint8Array> | Iterable<Uint8Array>, missionId: string,
                         pieceBytes: number): AsyncGenerator<MessageInitShape<typeof ImportMissionRequestSchema>> {
  yield { part: { case: 'start', value: { missionId } } };
  const digest = createHash('sha256');
  let crc = 0, size = 0;
  for await (const chunk of file) {
    for (let at = 0; at < chunk.length; at += pieceBytes) {
      const data = new Uint8Array(chunk.subarray(at, at + pieceBytes));
      crc = crc32(data, crc);
      digest.update(data);
      yield { part: { case: 'piece', value: { offsetBytes: BigInt(size), data, crc32: crc } } };
      size += data.length;
    }
  }
  yield { part: { case: 'end', value: { totalBytes: BigInt(size), sha256: new Uint8Array(digest.digest()) } } };
}
