// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import { inflate } from './inflate.ts';
import { MapLayer, MapTile_Encoding } from './wire/index.ts';
import type { MapTile } from './wire/index.ts';
import type { GridGeometry } from './wire/index.ts';

export const UNKNOWN = 0;
export const FREE = 1;
export const OCCUPIED = 2;

/** Where a raster lies: metres, frame map; cell (0, 0) is the south-west one. */
export type Geometry = {
  x_m: number;
  y_m: number;
  resolution_m: number;
  columns: number;
  rows: number;
};

/** A rectangle of cells, `to` not included. */
export type CellRect = { fromColumn: number; fromRow: number; toColumn: number; toRow: number };

/** None of a map that has no cells yet. */
export function geometryOf(proto: GridGeometry | undefined): Geometry | null {
  if (proto === undefined || proto.columnCount === 0 || proto.rowCount === 0) return null;
  return {
    x_m: proto.origin?.xM ?? 0,
    y_m: proto.origin?.yM ?? 0,
    resolution_m: proto.resolutionM,
    columns: proto.columnCount,
    rows: proto.rowCount,
  };
}

export function sameGeometry(a: Geometry, b: Geometry): boolean {
  return a.x_m === b.x_m && a.y_m === b.y_m && a.resolution_m === b.resolution_m &&
    a.columns === b.columns && a.rows === b.rows;
}

/** The cells of a tile of gas: ppm, or ppm squared; NaN where there is none. */
export function decodeGas(tile: MapTile): Float32Array {
  const count = tile.columnCount * tile.rowCount;
  const cells = new Float32Array(count);
  if (tile.encoding === MapTile_Encoding.F32) {
    const bytes = inflate(tile.deflatedData, count * 4);
    const view = new DataView(bytes.buffer);
    for (let i = 0; i < count; ++i) cells[i] = view.getFloat32(4 * i, true);
    return cells;
  }
  if (tile.encoding !== MapTile_Encoding.U16_SCALED) throw new Error('a gas tile of another encoding');
  const bytes = inflate(tile.deflatedData, count * 2);
  for (let i = 0; i < count; ++i) {
    const word = bytes[2 * i] | (bytes[2 * i + 1] << 8);
    cells[i] = word === 0xffff ? NaN : tile.valueOffset + tile.valueScale * word;
  }
  return cells;
}

/** The layers of a map, as far as they were told. */
export class Raster {
  readonly occupancy: Uint8Array;
  readonly mean_ppm: Float32Array;
  readonly variance_ppm2: Float32Array;

  constructor(readonly geometry: Geometry) {
    const count = geometry.columns * geometry.rows;
    this.occupancy = new Uint8Array(count);
    this.mean_ppm = new Float32Array(count).fill(NaN);
    this.variance_ppm2 = new Float32Array(count).fill(NaN);
  }

  /** Returns what changed. */
  apply(tile: MapTile): CellRect {
    const column = tile.minCell?.column ?? 0;
    const row = tile.minCell?.row ?? 0;
    const rect = {
      fromColumn: column, fromRow: row,
      toColumn: column + tile.columnCount, toRow: row + tile.rowCount,
    };
    if (column < 0 || row < 0 || rect.toColumn > this.geometry.columns ||
        rect.toRow > this.geometry.rows) {
      throw new Error('a tile beyond the map');
    }
    const count = tile.columnCount * tile.rowCount;
    const [from, to]: [ArrayLike<number>, Uint8Array | Float32Array] =
      tile.layer === MapLayer.OCCUPANCY ? [inflate(tile.deflatedData, count), this.occupancy]
      : tile.layer === MapLayer.GAS_MEAN ? [decodeGas(tile), this.mean_ppm]
                                         : [decodeGas(tile), this.variance_ppm2];
    for (let i = 0; i < tile.rowCount; ++i) {
      const begin = i * tile.columnCount;
      const row = (from as Uint8Array).subarray(begin, begin + tile.columnCount);
      to.set(row, (rect.fromRow + i) * this.geometry.columns + column);
    }
    return rect;
  }

  /** The cell at a place, or -1 beyond the map. */
  cellAt(x_m: number, y_m: number): number {
    const { geometry } = this;
    const column = Math.floor((x_m - geometry.x_m) / geometry.resolution_m);
    const row = Math.floor((y_m - geometry.y_m) / geometry.resolution_m);
    if (column < 0 || row < 0 || column >= geometry.columns || row >= geometry.rows) return -1;
    return row * geometry.columns + column;
  }

  copy(): Raster {
    const copy = new Raster(this.geometry);
    copy.occupancy.set(this.occupancy);
    copy.mean_ppm.set(this.mean_ppm);
    copy.variance_ppm2.set(this.variance_ppm2);
    return copy;
  }
}

export type RasterFigures = {
  known_m2: number;
  free_m2: number;
  plume_m2: number; // where the mean is above the threshold
  max_ppm: number; // NaN if there is no gas layer yet
  max_stddev_ppm: number;
  p99_stddev_ppm: number; // that 99 of 100 cells are not above, or up to an eighth more
  mean_entropy_nats: number; // differential entropy of the marginals, mean over free cells
};

// Variances by their logarithms, counted in bins.
const BINS_A_UNIT = 4;
const LEAST_LOG = -100;
const BINS = 200 * BINS_A_UNIT;

// The upper end of the bin that the last but a hundredth of them lie in.
function highVariance(bins: Uint32Array, count: number): number {
  let above = 0;
  for (let bin = BINS - 1; bin >= 0; --bin) {
    above += bins[bin];
    if (above > 0.01 * count) return Math.exp((bin + 1) / BINS_A_UNIT + LEAST_LOG);
  }
  return NaN;
}

export function figuresOf(raster: Raster, threshold_ppm: number): RasterFigures {
  const area = raster.geometry.resolution_m ** 2;
  let known = 0, free = 0, plume = 0, gas = 0, entropy = 0;
  let max = NaN, maxVariance = NaN;
  const { occupancy, mean_ppm, variance_ppm2 } = raster;
  const bins = new Uint32Array(BINS);
  for (let i = 0; i < occupancy.length; ++i) {
    if (occupancy[i] === UNKNOWN) continue;
    ++known;
    if (occupancy[i] === FREE) ++free;
    const mean = mean_ppm[i];
    if (mean !== mean) continue;
    if (!(mean <= max)) max = mean;
    if (threshold_ppm > 0 && mean > threshold_ppm) ++plume;
    const variance = variance_ppm2[i];
    if (!(variance > 0)) continue;
    if (!(variance <= maxVariance)) maxVariance = variance;
    ++gas;
    const log = Math.log(variance);
    entropy += 0.5 * (Math.log(2 * Math.PI * Math.E) + log);
    ++bins[Math.min(BINS - 1, Math.max(0, Math.floor((log - LEAST_LOG) * BINS_A_UNIT)))];
  }
  return {
    known_m2: known * area,
    free_m2: free * area,
    plume_m2: plume * area,
    max_ppm: max,
    max_stddev_ppm: Math.sqrt(maxVariance),
    p99_stddev_ppm: Math.sqrt(Math.min(maxVariance, highVariance(bins, gas))),
    mean_entropy_nats: gas === 0 ? NaN : entropy / gas,
  };
}

/** The mean now less the mean then, ppm, cell by cell of `now`, which may have grown. */
export function changeOf(now: Raster, then: Raster): Float32Array {
  const change = new Float32Array(now.mean_ppm.length);
  const g = now.geometry, h = then.geometry;
  const columns = Math.round((g.x_m - h.x_m) / g.resolution_m);
  const rows = Math.round((g.y_m - h.y_m) / g.resolution_m);
  for (let row = 0; row < g.rows; ++row) {
    for (let column = 0; column < g.columns; ++column) {
      const c = column + columns, r = row + rows;
      const inside = c >= 0 && r >= 0 && c < h.columns && r < h.rows;
      const i = row * g.columns + column;
      change[i] = inside ? now.mean_ppm[i] - then.mean_ppm[r * h.columns + c] : NaN;
    }
  }
  return change;
}
