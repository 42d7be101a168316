// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What maps are drawn with: places in metres become lines and marks in pixels.
import { roundUp } from './colours.ts';
import { theme } from './theme.ts';
import type { View } from './view.ts';
import type { Point2D } from '@plumescout/client/wire';

export class MapPen {
  constructor(private readonly context: CanvasRenderingContext2D, private readonly view: View) {}

  // Metres, or tens of them: what is unknown is a plane too.
  grid(): void {
    const { context: c, view } = this;
    const step = roundUp(40 / view.scale);
    const [left, top] = view.toPlace(0, 0), [right, bottom] = view.toPlace(view.width, view.height);
    c.strokeStyle = theme('--map-grid');
    c.lineWidth = 1;
    c.beginPath();
    for (let x = Math.ceil(left / step) * step; x < right; x += step) {
      const px = Math.round(view.toPixel(x, 0)[0]) + 0.5;
      c.moveTo(px, 0);
      c.lineTo(px, view.height);
    }
    for (let y = Math.ceil(bottom / step) * step; y < top; y += step) {
      const py = Math.round(view.toPixel(0, y)[1]) + 0.5;
      c.moveTo(0, py);
      c.lineTo(view.width, py);
    }
    c.stroke();
  }

  path(points: Iterable<{ xM: number; yM: number }>): void {
    let first = true;
    this.context.beginPath();
    for (const point of points) {
      const [x, y] = this.view.toPixel(point.xM, point.yM);
      if (first) this.context.moveTo(x, y);
      else this.context.lineTo(x, y);
      first = false;
    }
  }
  // A line that is seen on any ground: its colour on a rim.
  strokeTwice(colour: string, width: number, rim = 2.5): void {
    const c = this.context;
    c.lineJoin = c.lineCap = 'round';
    c.strokeStyle = theme('--map-rim');
    c.lineWidth = width + rim;
    c.stroke();
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.stroke();
  }

  cross(at: { x_m: number; y_m: number }, colour: string, size = 6, width = 2.5): void {
    const c = this.context;
    const [x, y] = this.view.toPixel(at.x_m, at.y_m);
    c.beginPath();
    c.moveTo(x - size, y - size);
    c.lineTo(x + size, y + size);
    c.moveTo(x + size, y - size);
    c.lineTo(x - size, y + size);
    this.strokeTwice(colour, width);
  }
  // Words that are read on any ground; x and y in pixels.
  label(text: string, x: number, y: number, align: CanvasTextAlign, baseline: CanvasTextBaseline): void {
    const c = this.context;
    c.font = '600 12px system-ui, sans-serif';
    c.textAlign = align;
    c.textBaseline = baseline;
    c.lineWidth = 3.5;
    c.strokeStyle = theme('--map-rim');
    c.strokeText(text, x, y);
    c.fillStyle = theme('--map-ink');
    c.fillText(text, x, y);
  }

  // A number in a circle.
  disc(at: Point2D, text: string, strong: boolean): void {
    const c = this.context;
    const [x, y] = this.view.toPixel(at.xM, at.yM);
    c.beginPath();
    c.arc(x, y, 9, 0, 2 * Math.PI);
    c.fillStyle = theme(strong ? '--map-ink' : '--map-rim');
    c.fill();
    c.strokeStyle = theme('--map-ink');
    c.lineWidth = 1.2;
    c.stroke();
    c.fillStyle = theme(strong ? '--map-rim' : '--map-ink');
    c.font = '600 11px system-ui, sans-serif';
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    c.fillText(text, x, y + 0.5);
  }

  scaleBar(): void {
    const { context: c, view } = this;
    const length_m = roundUp(60 / view.scale);
    const length = length_m * view.scale;
    const x = view.width - length - 16, y = view.height - 14;
    c.beginPath();
    c.moveTo(x, y - 5);
    c.lineTo(x, y);
    c.lineTo(x + length, y);
    c.lineTo(x + length, y - 5);
    this.strokeTwice(theme('--map-ink'), 1.5);
    this.label(`${length_m} m`, x + length / 2, y - 3, 'center', 'bottom');
  }
}
