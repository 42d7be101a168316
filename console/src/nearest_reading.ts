// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// How near and how old the nearest reading is, of the place that the pointer rests on.
import type { QueryGasResponse } from '@plumescout/client/wire';
import type { Place } from './area_draft.ts';
import { duration } from './words.ts';

// The pointer rests if it has not moved for so long.
const REST_MS = 150;
// While it rests on a map that goes on, the answer is made anew.
const AGAIN_MS = 2_000;

// Of one place; empty: nothing was measured yet.
export function nearestInWords({ gas: [at], sampleTimeNs }: Pick<QueryGasResponse, 'gas' | 'sampleTimeNs'>): string {
  if (at?.nearestReadingM === undefined) return '';
  const where = `nearest reading ${at.nearestReadingM.toFixed(1)} m away`;
  if (at.nearestReadingTimeNs === undefined) return where;
  const age_s = Number(sampleTimeNs - at.nearestReadingTimeNs) * 1e-9;
  return `${where}, ${age_s < 1 ? 'just now' : `${duration(Math.round(age_s))} ago`}`;
}

export type GasQuestion = {
  ask(place: Place, signal: AbortSignal): Promise<QueryGasResponse | null>; // null: not now
  goesOn(): boolean; // whether the answer will be another one soon
};

export class NearestReading {
  text = ''; // of where the pointer rests
  private timer: ReturnType<typeof setTimeout> | undefined;
  private call = new AbortController();

  constructor(private readonly question: GasQuestion, private readonly changed: () => void) {}

  // The pointer is there now; null: nowhere.
  move(place: Place | null): void {
    this.text = '';
    this.call.abort();
    clearTimeout(this.timer);
    if (place === null) return;
    const { signal } = this.call = new AbortController();
    this.timer = setTimeout(() => void this.ask(place, signal), REST_MS);
  }

  private async ask(place: Place, signal: AbortSignal): Promise<void> {
    let text = '';
    try {
      const answer = await this.question.ask(place, signal);
      if (answer !== null) text = nearestInWords(answer);
    } catch {
      // The stream's banner says what is the matter.
    }
    if (signal.aborted) return;
    this.text = text;
    this.changed();
    if (this.question.goesOn()) this.timer = setTimeout(() => void this.ask(place, signal), AGAIN_MS);
  }
}
