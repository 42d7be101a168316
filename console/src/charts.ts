// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Small lines over time.
import { figure } from './words.ts';

export type Sample = { t_s: number; value: number };

// Values over time, thinned evenly once there are too many: an hour and a day cost the same.
export class Series {
  readonly samples: Sample[] = [];
  private every = 1;
  private count = 0;

  constructor(private readonly limit = 900) {}

  add(t_s: number, value: number): void {
    if (!Number.isFinite(value) || this.count++ % this.every !== 0) return;
    this.samples.push({ t_s, value });
    if (this.samples.length < this.limit) return;
    const kept = this.samples.filter((_, i) => i % 2 === 0);
    this.samples.splice(0, this.samples.length, ...kept);
    this.every *= 2;
  }
  get last(): number {
    return this.samples.at(-1)?.value ?? NaN;
  }
}

export type Line = { name: string; samples: Sample[]; colour: string };

export type Span = { from_s: number; to_s: number };

// From the first value of any line to the last.
export function spanOf(lines: Line[]): Span {
  const ends = lines.flatMap(({ samples }) => (samples.length === 0 ? [] : [samples[0].t_s, samples.at(-1)!.t_s]));
  return { from_s: Math.min(...ends), to_s: Math.max(...ends) };
}

export function drawChart(canvas: HTMLCanvasElement, lines: Line[], unit: string, span = spanOf(lines)): void {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (width === 0) return;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const c = canvas.getContext('2d')!;
  c.scale(ratio, ratio);
  const style = getComputedStyle(canvas);
  const left = 44, right = width - 6, top = 6, bottom = height - 16;
  const { from_s: minT, to_s: maxT } = span;
  let min = 0, max = -Infinity;
  for (const line of lines) {
    for (const { value } of line.samples) {
      min = Math.min(min, value);
      max = Math.max(max, value);
    }
  }
  c.font = '11px system-ui, sans-serif';
  c.fillStyle = style.getPropertyValue('--quiet');
  if (!(maxT > minT) || !(max > -Infinity)) {
    c.textAlign = 'center';
    c.fillText('waiting for a second value', width / 2, height / 2);
    return;
  }
  if (unit === '%') max = Math.max(max, 100);
  if (max <= min) max = min + 1;
  const x = (t: number) => left + ((t - minT) / (maxT - minT)) * (right - left);
  const y = (v: number) => bottom - ((v - min) / (max - min)) * (bottom - top);
  c.strokeStyle = style.getPropertyValue('--line');
  c.beginPath();
  for (const value of [min, (min + max) / 2, max]) {
    c.moveTo(left, y(value));
    c.lineTo(right, y(value));
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    c.fillText(figure(value, 2), left - 5, Math.min(Math.max(y(value), 7), height - 20));
  }
  c.stroke();
  c.textBaseline = 'bottom';
  c.textAlign = 'left';
  c.fillText(unit, left, height);
  c.textAlign = 'right';
  c.fillText(`last ${figure((maxT - minT) < 120 ? maxT - minT : (maxT - minT) / 60, 2)} ` +
             ((maxT - minT) < 120 ? 's' : 'min'), right, height);
  c.lineWidth = 1.75;
  c.lineJoin = 'round';
  for (const line of lines) {
    c.strokeStyle = line.colour;
    c.beginPath();
    line.samples.forEach(({ t_s, value }, i) => {
      if (i === 0) c.moveTo(x(t_s), y(value));
      else c.lineTo(x(t_s), y(value));
    });
    c.stroke();
  }
}
