// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Missions as files.
import { OwnAbort } from './abort.ts';
import type { Client } from './client.ts';
import { MissionFileFormat } from './wire/index.ts';

const CRC_TABLE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let rest = byte;
  for (let bit = 0; bit < 8; ++bit) rest = (rest >>> 1) ^ (rest & 1 ? 0xedb88320 : 0);
  return rest;
});

/** As zlib computes it; `before`: of the bytes that come before these. */
export function crc32(data: Uint8Array, before = 0): number {
  let rest = ~before;
  for (let i = 0; i < data.length; ++i) rest = (rest >>> 8) ^ CRC_TABLE[(rest ^ data[i]!) & 255]!;
  return ~rest >>> 0;
}

export type FilePiece = {
  data: Uint8Array;
  done_bytes: number; // with this piece
  expected_bytes: number; // of the whole, about
};

export type ExportOptions = {
  format?: MissionFileFormat; // a journal, which importMission takes, or MCAP, which Foxglove shows
  signal?: AbortSignal;
};

/** The file of missions/{mission}, in pieces. What is not as the server sent it is thrown: a file is
 * whole once the loop has come to its end, and only then. */
export async function* exportMission(client: Client, mission: string,
                                     options: ExportOptions = {}): AsyncGenerator<FilePiece, void> {
  const request = { mission, format: options.format ?? MissionFileFormat.JOURNAL };
  let crc = 0, done_bytes = 0, expected_bytes = 0;
  const abort = new OwnAbort(options.signal);
  try {
    for await (const { part } of client.snapshots.exportMission(request, { signal: abort.signal })) {
      if (part.case === 'start') {
        expected_bytes = Number(part.value.expectedBytes);
      } else if (part.case === 'piece') {
        const { data } = part.value;
        crc = crc32(data, crc);
        if (Number(part.value.offsetBytes) !== done_bytes || part.value.crc32 !== crc) {
          throw new Error(`the piece at byte ${done_bytes} is not what was sent`);
        }
        done_bytes += data.length;
        yield { data, done_bytes, expected_bytes: Math.max(done_bytes, expected_bytes) };
      } else if (part.case === 'end') {
        if (Number(part.value.totalBytes) === done_bytes) return;
        throw new Error(`of ${part.value.totalBytes} bytes, ${done_bytes} came`);
      }
    }
  } finally {
    abort.end();
  }
  throw new Error(`the export ends after ${done_bytes} bytes, before its end`);
}
