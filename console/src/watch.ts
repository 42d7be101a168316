// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A mission's map as it changes, for as long as anybody sees the page.
import { MAX_CELLS, getMap, watchMap } from '@plumescout/client';
import type { CellRect, Raster } from '@plumescout/client';
import type { MapStatus } from '@plumescout/client/wire';
import { client, troubleOf, troubleOfCall } from './client.ts';
import type { Trouble } from './client.ts';

export type LinkState = 'connecting' | 'live' | 'waiting' | 'hidden' | 'ended';

export type WatchEvents = {
  // The map is another one: draw all of it.
  replaced(raster: Raster): void;
  // Cells of it changed.
  changed(rects: CellRect[]): void;
  status(status: MapStatus, revision: bigint): void;
  link(state: LinkState, trouble: Trouble | null, again_s: number): void;
};

// Streams of a tab that nobody sees are given up after this.
const HIDDEN_PATIENCE_MS = 5_000;

export type Replay = { fromRevision: bigint; speed: number };

export class Watch {
  private stopped = false;
  private abort = new AbortController();
  private hiddenTimer = 0;
  private hidden = document.hidden; // for so long that no stream is held
  private wake: () => void = () => {};

  constructor(private readonly mission: string, private readonly events: WatchEvents,
              private readonly gas = '', private readonly replay: Replay | null = null) {
    document.addEventListener('visibilitychange', this.onVisibility);
    void this.run();
  }

  stop(): void {
    this.stopped = true;
    document.removeEventListener('visibilitychange', this.onVisibility);
    window.clearTimeout(this.hiddenTimer);
    this.abort.abort();
    this.wake();
  }
  // Does not wait for the end of a pause.
  retry(): void {
    this.abort.abort();
  }

  private readonly onVisibility = () => {
    window.clearTimeout(this.hiddenTimer);
    if (document.hidden) {
      this.hiddenTimer = window.setTimeout(() => {
        this.hidden = true;
        this.abort.abort();
        this.events.link('hidden', null, 0); // at once, if this is in a pause
      }, HIDDEN_PATIENCE_MS);
    } else if (this.hidden) {
      this.hidden = false;
      this.wake();
    }
  };

  // Until somebody looks, or it is stopped.
  private seen(): Promise<void> {
    return new Promise((resolve) => { this.wake = resolve; });
  }

  private async run(): Promise<void> {
    while (!this.stopped) {
      if (this.hidden) {
        this.events.link('hidden', null, 0);
        await this.seen();
        continue;
      }
      this.abort = new AbortController();
      try {
        await this.read();
      } catch (error) {
        if (!this.stopped) this.events.link('ended', troubleOf(error), 0);
        return;
      }
    }
  }

  private async read(): Promise<void> {
    const { signal } = this.abort;
    const replay = this.replay === null ? {}
      : { fromRevision: this.replay.fromRevision, speedRatio: this.replay.speed };
    const updates = watchMap(client, this.mission, { ...replay, ...speciesOf(this.gas), signal, onLink: (state, error, again_s) => {
      if (!signal.aborted) this.events.link(state, error === null ? null : troubleOfCall(error), again_s);
    } });
    for await (const { raster, status, revision, changed } of updates) {
      if (signal.aborted) return;
      this.events.status(status, revision);
      if (changed === 'all' && raster !== null) this.events.replaced(raster);
      else if (changed !== 'all' && changed.length > 0) this.events.changed(changed);
    }
  }
}

// Cells of a map that is saved: 324 MB while it is made.
const MAX_SAVED_CELLS = 9 * MAX_CELLS;

// What a map is of: a revision, 0: as it is now; a gas, empty: the mission's first.
export type Moment = { revision: bigint; gas: string };

const speciesOf = (gas: string) => (gas === '' ? {} : { species: gas });

// Of a map with more cells than a page holds, squares of cells.
// `saved`: it is not drawn, so of more cells, and with gas to the last digit.
export async function fetchMap(mission: string, { revision, gas }: Moment, signal: AbortSignal,
                               saved = false): Promise<{ raster: Raster; status: MapStatus }> {
  const { raster, status } = await getMap(client, mission, {
    revision, ...speciesOf(gas), signal, fullPrecision: saved, maxCells: saved ? MAX_SAVED_CELLS : MAX_CELLS });
  if (raster === null) throw new Error('the mission had no map yet');
  return { raster, status };
}
