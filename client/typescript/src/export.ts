// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Maps as files that other programs read.
import { FREE, OCCUPIED } from './raster.ts';
import type { Raster } from './raster.ts';

/** NumPy's format, version 1.0: float32, rows from the south. */
export function npyOf(values: Float32Array, rows: number, columns: number): Uint8Array {
  const header = `{'descr': '<f4', 'fortran_order': False, 'shape': (${rows}, ${columns}), }`;
  const padded = header.padEnd(Math.ceil((header.length + 11) / 64) * 64 - 11) + '\n';
  const bytes = new Uint8Array(10 + padded.length + 4 * values.length);
  bytes.set([0x93, ...[...'NUMPY'].map((c) => c.charCodeAt(0)), 1, 0, padded.length & 255,
             padded.length >> 8]);
  bytes.set(new TextEncoder().encode(padded), 10);
  const view = new DataView(bytes.buffer, 10 + padded.length);
  values.forEach((value, i) => view.setFloat32(4 * i, value, true));
  return bytes;
}

/** Of map_server: black is occupied, nearly white free, grey unknown; rows from the north. */
export function pgmOf(raster: Raster): Uint8Array {
  const { columns, rows } = raster.geometry;
  const head = new TextEncoder().encode(`P5\n${columns} ${rows}\n255\n`);
  const bytes = new Uint8Array(head.length + columns * rows);
  bytes.set(head);
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const state = raster.occupancy[row * columns + column];
      bytes[head.length + (rows - 1 - row) * columns + column] =
        state === OCCUPIED ? 0 : state === FREE ? 254 : 205;
    }
  }
  return bytes;
}

export function mapYamlOf(raster: Raster, image: string): string {
  const { x_m, y_m, resolution_m } = raster.geometry;
  return `image: ${image}\nmode: trinary\nresolution: ${resolution_m}\n` +
    `origin: [${x_m}, ${y_m}, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n`;
}
