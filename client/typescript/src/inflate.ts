// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// RFC 1950 and 1951. Tiles are small and many, and the browser's own inflater answers each in a turn
// of its own: this one answers at once.

const LENGTH_BASE = [3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23, 27, 31, 35, 43, 51, 59, 67, 83,
  99, 115, 131, 163, 195, 227, 258];
const LENGTH_BITS = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5,
  5, 0];
const DISTANCE_BASE = [1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193, 257, 385, 513, 769,
  1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577];
const DISTANCE_BITS = [0, 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9, 9, 10, 10, 11,
  11, 12, 12, 13, 13];
const CODE_ORDER = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];
const MAX_CODE_BITS = 15;

// A code by a table of all MAX_CODE_BITS-bit words that may follow: symbol << 4 | bits; 0 is no code.
type Code = { table: Uint16Array; bits: number };

function makeCode(lengths: ArrayLike<number>): Code {
  let bits = 1;
  for (let i = 0; i < lengths.length; ++i) bits = Math.max(bits, lengths[i]);
  const counts = new Uint16Array(MAX_CODE_BITS + 2);
  for (let i = 0; i < lengths.length; ++i) ++counts[lengths[i]];
  counts[0] = 0;
  const next = new Uint16Array(MAX_CODE_BITS + 2);
  for (let length = 1; length <= MAX_CODE_BITS; ++length) {
    next[length + 1] = (next[length] + counts[length]) << 1;
  }
  const table = new Uint16Array(1 << bits);
  for (let symbol = 0; symbol < lengths.length; ++symbol) {
    const length = lengths[symbol];
    if (length === 0) continue;
    const word = next[length]++;
    let reversed = 0;
    for (let bit = 0; bit < length; ++bit) reversed |= ((word >> bit) & 1) << (length - 1 - bit);
    for (let at = reversed; at < table.length; at += 1 << length) {
      table[at] = (symbol << 4) | length;
    }
  }
  return { table, bits };
}

let fixed: [Code, Code] | null = null;

function fixedCodes(): [Code, Code] {
  if (fixed === null) {
    const lengths = new Uint8Array(288).fill(8, 0, 144).fill(9, 144, 256).fill(7, 256, 280).fill(8, 280);
    fixed = [makeCode(lengths), makeCode(new Uint8Array(30).fill(5))];
  }
  return fixed;
}

class Reader {
  private held = 0;
  private count = 0;
  constructor(private readonly data: Uint8Array, private at: number) {}

  need(bits: number): number {
    while (this.count < bits) {
      if (this.at > this.data.length + 4) throw new Error('deflated data is cut off');
      this.held |= (this.data[this.at++] ?? 0) << this.count;
      this.count += 8;
    }
    return this.held & ((1 << bits) - 1);
  }
  take(bits: number): number {
    const value = this.need(bits);
    this.held >>>= bits;
    this.count -= bits;
    return value;
  }
  symbol(code: Code): number {
    const entry = code.table[this.need(code.bits)];
    if (entry === 0) throw new Error('deflated data has a word that is no code');
    this.take(entry & 15);
    return entry >> 4;
  }
  // Drops the rest of a byte; the next `length` bytes.
  bytes(): { size: number; from: number } {
    this.take(this.count & 7);
    const size = this.take(16);
    if ((size ^ this.take(16)) !== 0xffff) throw new Error('deflated data has a bad stored block');
    const from = this.at - this.count / 8;
    this.held = this.count = 0;
    this.at = from + size;
    if (this.at > this.data.length) throw new Error('deflated data is cut off');
    return { size, from };
  }
}

function readCodes(reader: Reader): [Code, Code] {
  const literals = reader.take(5) + 257;
  const distances = reader.take(5) + 1;
  const count = reader.take(4) + 4;
  const order = new Uint8Array(19);
  for (let i = 0; i < count; ++i) order[CODE_ORDER[i]] = reader.take(3);
  const code = makeCode(order);
  const lengths = new Uint8Array(literals + distances);
  for (let i = 0; i < lengths.length; ) {
    const symbol = reader.symbol(code);
    if (symbol < 16) {
      lengths[i++] = symbol;
      continue;
    }
    const value = symbol === 16 ? lengths[i - 1] : 0;
    const run = symbol === 16 ? 3 + reader.take(2) : symbol === 17 ? 3 + reader.take(3)
                                                                    : 11 + reader.take(7);
    if (i + run > lengths.length) throw new Error('deflated data has bad code lengths');
    lengths.fill(value, i, i + run);
    i += run;
  }
  return [makeCode(lengths.subarray(0, literals)), makeCode(lengths.subarray(literals))];
}

// Inflates zlib data that is known to hold `size` bytes; throws Error on anything else.
export function inflate(data: Uint8Array, size: number): Uint8Array {
  if (data.length < 6 || (data[0] & 15) !== 8 || ((data[0] << 8) | data[1]) % 31 !== 0) {
    throw new Error('no zlib data');
  }
  const out = new Uint8Array(size);
  const reader = new Reader(data, 2);
  let at = 0;
  for (let last = false; !last; ) {
    last = reader.take(1) === 1;
    const kind = reader.take(2);
    if (kind === 3) throw new Error('deflated data has a bad block');
    if (kind === 0) {
      const stored = reader.bytes();
      if (at + stored.size > size) throw new Error('deflated data is too long');
      out.set(data.subarray(stored.from, stored.from + stored.size), at);
      at += stored.size;
      continue;
    }
    const [literals, distances] = kind === 1 ? fixedCodes() : readCodes(reader);
    for (;;) {
      const symbol = reader.symbol(literals);
      if (symbol === 256) break;
      if (symbol < 256) {
        if (at >= size) throw new Error('deflated data is too long');
        out[at++] = symbol;
        continue;
      }
      const length = LENGTH_BASE[symbol - 257] + reader.take(LENGTH_BITS[symbol - 257]);
      const word = reader.symbol(distances);
      const distance = DISTANCE_BASE[word] + reader.take(DISTANCE_BITS[word]);
      if (distance > at || at + length > size) throw new Error('deflated data is too long');
      for (let i = 0; i < length; ++i, ++at) out[at] = out[at - distance];
    }
  }
  if (at !== size) throw new Error('deflated data is too short');
  return out;
}
