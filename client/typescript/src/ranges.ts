// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Scans as they go on the wire.

const RANGE_UNIT_M = 0.005;
const NO_RETURN = 0, INVALID = 65535; // counts with a meaning of their own

/** Metres; Infinity: nothing seen, NaN: the beam says nothing. Little-endian counts of unit_m. */
export function encodeRanges(ranges_m: ArrayLike<number>): { ranges_u16: Uint8Array; unit_m: number } {
  let longest_m = 0;
  for (let i = 0; i < ranges_m.length; ++i) {
    const range_m = ranges_m[i]!;
    if (range_m < Infinity && range_m > longest_m) longest_m = range_m;
  }
  const unit_m = Math.max(RANGE_UNIT_M, longest_m / (INVALID - 1));
  const ranges_u16 = new Uint8Array(2 * ranges_m.length);
  const view = new DataView(ranges_u16.buffer);
  for (let i = 0; i < ranges_m.length; ++i) {
    const range_m = ranges_m[i]!;
    const count = range_m === Infinity ? NO_RETURN
      : range_m > 0 ? Math.min(Math.max(Math.round(range_m / unit_m), 1), INVALID - 1) : INVALID;
    view.setUint16(2 * i, count, true);
  }
  return { ranges_u16, unit_m };
}
