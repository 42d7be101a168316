// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What a place holds, in words.
import { FREE, OCCUPIED } from '@plumescout/client';
import type { Raster } from '@plumescout/client';
import type { Place } from './area_draft.ts';
import { figure } from './words.ts';

type Cell = { state: string; mean_ppm: number; stddev_ppm: number }; // NaN: there is no gas

function cellAt(raster: Raster | null, { x_m, y_m }: Place): Cell {
  const cell = raster?.cellAt(x_m, y_m) ?? -1;
  if (raster === null || cell < 0) return { state: 'off the map', mean_ppm: NaN, stddev_ppm: NaN };
  const state = raster.occupancy[cell];
  return { state: state === OCCUPIED ? 'occupied' : state === FREE ? 'free' : 'unknown',
           mean_ppm: raster.mean_ppm[cell], stddev_ppm: Math.sqrt(raster.variance_ppm2[cell]) };
}

const gasInWords = ({ mean_ppm, stddev_ppm }: Cell) => `${figure(mean_ppm)} ± ${figure(stddev_ppm)} ppm`;

export function cellInWords(raster: Raster | null, place: Place): string {
  const cell = cellAt(raster, place);
  return Number.isNaN(cell.mean_ppm) ? cell.state : `${cell.state} · ${gasInWords(cell)}`;
}

// At two moments, and what the mean did from the one to the other.
export function cellsInWords(then: Raster | null, now: Raster | null, place: Place): string {
  const [before, after] = [cellAt(then, place), cellAt(now, place)];
  const told = (cell: Cell) => (Number.isNaN(cell.mean_ppm) ? cell.state : gasInWords(cell));
  const change_ppm = after.mean_ppm - before.mean_ppm;
  return `then ${told(before)} · now ${told(after)}` + (Number.isNaN(change_ppm) ? ''
    : ` · change ${change_ppm > 0 ? '+' : ''}${figure(change_ppm)} ppm`);
}
