// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What part of the plane the canvas shows: y points north, so rows of pixels run the other way.
import { UNKNOWN } from '@plumescout/client';
import type { CellRect, Raster } from '@plumescout/client';

export type Box = { minX: number; minY: number; maxX: number; maxY: number };
export type Corner = { width: number; height: number };

// The smallest rectangle of cells with what is known in `rect`, and with `before`.
export function knownIn(raster: Raster, rect: CellRect, before: CellRect | null): CellRect | null {
  const { columns } = raster.geometry;
  let { fromColumn, fromRow, toColumn, toRow } = before ?? {
    fromColumn: Infinity, fromRow: Infinity, toColumn: -Infinity, toRow: -Infinity };
  for (let row = rect.fromRow; row < rect.toRow; ++row) {
    for (let column = rect.fromColumn; column < rect.toColumn; ++column) {
      if (raster.occupancy[row * columns + column] === UNKNOWN) continue;
      if (column < fromColumn) fromColumn = column;
      if (column >= toColumn) toColumn = column + 1;
      if (row < fromRow) fromRow = row;
      if (row >= toRow) toRow = row + 1;
    }
  }
  return toRow < 0 ? null : { fromColumn, fromRow, toColumn, toRow };
}

const MARGIN = 24; // around what is fitted, pixels
const MIN_SCALE = 0.5; // pixels a metre
const MAX_SCALE = 800;

export class View {
  centreX_m = 0;
  centreY_m = 0;
  scale = 20; // pixels a metre
  width = 1;
  height = 1;

  toPixel(x_m: number, y_m: number): [number, number] {
    return [
      this.width / 2 + (x_m - this.centreX_m) * this.scale,
      this.height / 2 - (y_m - this.centreY_m) * this.scale,
    ];
  }
  toPlace(x: number, y: number): [number, number] {
    return [
      this.centreX_m + (x - this.width / 2) / this.scale,
      this.centreY_m - (y - this.height / 2) / this.scale,
    ];
  }
  pan(dx: number, dy: number): void {
    this.centreX_m -= dx / this.scale;
    this.centreY_m += dy / this.scale;
  }
  // The place under the pixel stays there.
  zoom(factor: number, x = this.width / 2, y = this.height / 2): void {
    const [x_m, y_m] = this.toPlace(x, y);
    this.scale = Math.min(MAX_SCALE, Math.max(MIN_SCALE, this.scale * factor));
    const [nowX, nowY] = this.toPixel(x_m, y_m);
    this.pan(x - nowX, y - nowY);
  }
  // All of the box, as large as it can be: below `top` pixels that something else covers, and beside or
  // above what covers the lower left `corner`.
  fit(box: Box, top = 0, corner: Corner = { width: 0, height: 0 }): void {
    const ways = [[0, 0], [corner.width, 0], [0, corner.height]].map(([left, bottom]) =>
      ({ left, bottom, scale: this.scaleFor(box, left, top + bottom) }));
    ways.sort((a, b) => b.scale - a.scale);
    for (const { left, bottom, scale } of ways) {
      this.scale = scale;
      this.centreX_m = (box.minX + box.maxX) / 2 - left / 2 / scale;
      this.centreY_m = (box.minY + box.maxY) / 2 + (top - bottom) / 2 / scale;
      const [x, y] = this.toPixel(box.minX, box.minY);
      if (x >= corner.width || y <= this.height - corner.height) return;
    }
  }
  private scaleFor(box: Box, left: number, above: number): number {
    const width = Math.max(box.maxX - box.minX, 0.5), height = Math.max(box.maxY - box.minY, 0.5);
    return Math.min(MAX_SCALE, Math.max(MIN_SCALE, Math.min(
      Math.max(this.width - left - 2 * MARGIN, 40) / width,
      Math.max(this.height - above - 2 * MARGIN, 40) / height)));
  }
}
