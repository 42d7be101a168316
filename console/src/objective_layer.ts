// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// How a mission's objective stands, square by square: what the server says of the middle of each.
import { FREE } from '@plumescout/client';
import type { Raster } from '@plumescout/client';
import { ObjectiveVerdict } from '@plumescout/client/wire';
import type { GasAtPoint, ObjectiveOptions, QueryGasResponse } from '@plumescout/client/wire';
import type { Place } from './area_draft.ts';

// As many places as the server answers for at once.
export const MOST_PLACES = 4096;
// While it is shown of a map that goes on, it is asked for anew.
const AGAIN_MS = 2_000;

export type Outlook = 'below' | 'above' | 'refuted' | 'undecided' | 'unmeasured';
export type JudgedSquare = Place & { size_m: number; outlook: Outlook };

// The middles of squares that lie on free cells, of the smallest squares of which there are not more than so many.
export function squaresOf(raster: Raster, most = MOST_PLACES): { places: Place[]; size_m: number } {
  const { columns, rows, resolution_m, x_m, y_m } = raster.geometry;
  for (let side = 1; ; ++side) {
    const places: Place[] = [];
    const middle = Math.floor(side / 2);
    for (let row = middle; row < rows && places.length <= most; row += side) {
      for (let column = middle; column < columns && places.length <= most; column += side) {
        if (raster.occupancy[row * columns + column] !== FREE) continue;
        places.push({ x_m: x_m + (column + 0.5) * resolution_m, y_m: y_m + (row + 0.5) * resolution_m });
      }
    }
    if (places.length <= most) return { places, size_m: side * resolution_m };
  }
}

// A verdict a cell of `raster`: that of the middle of the square that it lies in.
export function spread(raster: Raster, places: Place[], size_m: number, verdicts: number[]): Uint8Array {
  const { columns, rows, resolution_m, x_m, y_m } = raster.geometry;
  const side = Math.round(size_m / resolution_m);
  const cells = new Uint8Array(columns * rows);
  places.forEach((place, i) => {
    const fromColumn = Math.floor(((place.x_m - x_m) / resolution_m) / side) * side;
    const fromRow = Math.floor(((place.y_m - y_m) / resolution_m) / side) * side;
    for (let row = fromRow; row < Math.min(fromRow + side, rows); ++row) {
      cells.fill(verdicts[i], row * columns + fromColumn, row * columns + Math.min(fromColumn + side, columns));
    }
  });
  return cells;
}

export function outlookOf({ verdict, meanPpm }: GasAtPoint, threshold_ppm: number): Outlook | null {
  switch (verdict) {
    case ObjectiveVerdict.NOT_MEASURED: return 'unmeasured';
    case ObjectiveVerdict.UNDECIDED: return 'undecided';
    case ObjectiveVerdict.REFUTED: return 'refuted';
    case ObjectiveVerdict.DECIDED: return (meanPpm ?? 0) > threshold_ppm ? 'above' : 'below';
    default: return null; // it does not count
  }
}

export function judgedSquares(places: Place[], size_m: number, gas: GasAtPoint[], threshold_ppm: number): JudgedSquare[] {
  return places.flatMap((place, i) => {
    const outlook = gas[i] === undefined ? null : outlookOf(gas[i], threshold_ppm);
    return outlook === null ? [] : [{ ...place, size_m, outlook }];
  });
}

export type ObjectiveQuestion = {
  ask(places: Place[], signal: AbortSignal): Promise<QueryGasResponse | null>; // null: not now
  goesOn(): boolean; // whether the answer will be another one soon
  asked(): ObjectiveOptions | undefined; // what the mission is for, once that is known
  mostPlaces: number; // that are answered for at once
};

export class ObjectiveLayer {
  squares: JudgedSquare[] = [];
  private timer: ReturnType<typeof setTimeout> | undefined;
  private call = new AbortController();

  constructor(private readonly question: ObjectiveQuestion, private readonly raster: () => Raster | null,
              private readonly changed: () => void) {}

  // It is looked at, of this moment, from now on; or not any more.
  show(on: boolean): void {
    this.call.abort();
    clearTimeout(this.timer);
    this.squares = [];
    if (!on) return;
    const { signal } = this.call = new AbortController();
    void this.ask(signal);
  }

  private async ask(signal: AbortSignal): Promise<void> {
    const raster = this.raster();
    const { places, size_m } = raster === null ? { places: [], size_m: 0 } : squaresOf(raster, this.question.mostPlaces);
    try {
      const answer = places.length === 0 ? null : await this.question.ask(places, signal);
      if (signal.aborted) return;
      if (answer !== null) {
        this.squares = judgedSquares(places, size_m, answer.gas, this.question.asked()?.thresholdPpm ?? Infinity);
        this.changed();
      }
    } catch {
      // The stream's banner says what is the matter.
    }
    if (!signal.aborted && this.question.goesOn()) this.timer = setTimeout(() => void this.ask(signal), AGAIN_MS);
  }
}
