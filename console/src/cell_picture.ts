// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The cells of a map as a picture, a pixel each, north up; repainted where they change.
import { CHANGE, GAS, UNCERTAINTY, roundUp, shareOf } from './colours.ts';
import type { Colours, Rgb, Scale } from './colours.ts';
import { FREE, OCCUPIED, changeOf } from '@plumescout/client';
import type { CellRect, Raster, RasterFigures } from '@plumescout/client';
import { theme } from './theme.ts';

export type CellLayer = 'mean' | 'uncertainty' | 'change' | 'objective' | 'none';
// Those that have colours of cells, and with them a scale.
export const hasScale = (layer: CellLayer) => layer !== 'none' && layer !== 'objective';

// What the picture is of.
export type Cells = {
  raster: Raster | null;
  then: Raster | null; // of the instant to compare with
  figures: RasterFigures | null;
  threshold_ppm: number; // above which gas counts as a plume
  beside: Cells | null; // of a map beside it, on the same scale
};

function rgbOf(css: string): Rgb {
  const hex = css.replace('#', '');
  return [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16)) as Rgb;
}

const pack = ([r, g, b]: Rgb) => ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;

// The ends of the scale for what is shown.
export function scaleOf(layer: CellLayer, log: boolean, cells: Cells, change: Float32Array | null): Scale {
  const both = [cells, ...(cells.beside === null ? [] : [cells.beside])];
  if (layer === 'uncertainty') {
    const max = Math.max(...both.map(({ figures }) => figures?.p99_stddev_ppm || 0));
    return { min: 0, max: roundUp(max), log: false };
  }
  if (layer === 'change') {
    let max = 0;
    for (const value of change ?? []) if (Math.abs(value) > max) max = Math.abs(value);
    return { min: -roundUp(max), max: roundUp(max), log: false };
  }
  const max = roundUp(Math.max(0.1, ...both.flatMap(({ figures, threshold_ppm }) =>
    [figures?.max_ppm || 0, threshold_ppm])));
  return { min: log ? max / 1000 : 0, max, log };
}

export class CellPicture {
  layer: CellLayer = 'mean';
  log = true;
  scale: Scale = { min: 0.1, max: 100, log: true };
  readonly canvas = document.createElement('canvas');

  private image: ImageData | null = null;
  private of: Raster | null = null; // what is painted; null: nothing that holds
  private change: Float32Array | null = null;
  private key = '';

  constructor(private readonly cells: () => Cells) {}

  colours(): Colours {
    return this.layer === 'uncertainty' ? UNCERTAINTY : this.layer === 'change' ? CHANGE : GAS;
  }
  // All of it is to be painted again.
  forget(): void {
    this.of = null;
  }
  // Cells have changed.
  update(rects: CellRect[]): void {
    if (this.of !== this.cells().raster || this.layer === 'change') this.of = null;
    else if (this.rescale()) for (const rect of rects) this.paint(this.of!, rect);
  }
  // What the scale's ends depend on has changed.
  rescaleIfNeeded(): void {
    if (this.of !== null) this.rescale();
  }
  // Ready to be drawn.
  prepare(): void {
    const { raster, then } = this.cells();
    if (raster === null || this.of === raster) return;
    const { columns, rows } = raster.geometry;
    this.change = this.layer === 'change' && then !== null ? changeOf(raster, then) : null;
    this.rescale();
    if (this.image === null || this.image.width !== columns || this.image.height !== rows) {
      this.canvas.width = columns;
      this.canvas.height = rows;
      this.image = new ImageData(columns, rows);
    }
    this.of = raster;
    this.paint(raster, { fromColumn: 0, fromRow: 0, toColumn: columns, toRow: rows });
  }

  // False if the ends of the scale have moved, and all cells are to be painted again.
  private rescale(): boolean {
    this.scale = scaleOf(this.layer, this.log, this.cells(), this.change);
    const key = JSON.stringify([this.scale, this.layer]);
    const same = key === this.key;
    this.key = key;
    if (!same) this.of = null;
    return same;
  }

  private values(raster: Raster): Float32Array | null {
    switch (this.layer) {
      case 'mean': return raster.mean_ppm;
      case 'uncertainty': return raster.variance_ppm2;
      case 'change': return this.change;
      case 'objective': // drawn as squares on top
      case 'none': return null;
    }
  }

  private paint(raster: Raster, rect: CellRect): void {
    const { columns, rows } = raster.geometry;
    const image = this.image!;
    const pixels = new Uint32Array(image.data.buffer);
    const free = pack(rgbOf(theme('--map-free')));
    const wall = pack(rgbOf(theme('--map-wall')));
    const lookup = this.colours().map(pack);
    const values = this.values(raster);
    const root = this.layer === 'uncertainty';
    for (let row = rect.fromRow; row < rect.toRow; ++row) {
      const to = (rows - 1 - row) * columns;
      for (let column = rect.fromColumn; column < rect.toColumn; ++column) {
        const i = row * columns + column;
        const state = raster.occupancy[i];
        let colour = state === OCCUPIED ? wall : state === FREE ? free : 0;
        if (state === FREE && values !== null) {
          const value = root ? Math.sqrt(values[i]) : values[i];
          if (value === value) colour = lookup[(shareOf(this.scale, value) * 255) | 0];
        }
        pixels[to + column] = colour;
      }
    }
    this.canvas.getContext('2d')!.putImageData(image, 0, 0, rect.fromColumn, rows - rect.toRow,
      rect.toColumn - rect.fromColumn, rect.toRow - rect.fromRow);
  }
}
