// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What part of the plane the canvas shows: y points north, so rows of pixels run the other way.
export type Box = { minX: number; minY: number; maxX: number; maxY: number };

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
  // All of the box, below `top` pixels that something else covers.
  fit(box: Box, top = 0, margin = 24): void {
    const width = Math.max(box.maxX - box.minX, 0.5), height = Math.max(box.maxY - box.minY, 0.5);
    this.scale = Math.min(MAX_SCALE, Math.max(MIN_SCALE, Math.min(
      Math.max(this.width - 2 * margin, 40) / width,
      Math.max(this.height - top - 2 * margin, 40) / height)));
    this.centreX_m = (box.minX + box.maxX) / 2;
    this.centreY_m = (box.minY + box.maxY) / 2 + top / 2 / this.scale;
  }
}
