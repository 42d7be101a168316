// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A mission's map as it changes: one stream, opened again whenever it ends.
import { Code } from '@connectrpc/connect';
import { maps, troubleOf } from './client.ts';
import type { Trouble } from './client.ts';
import { MapCopy, levelFor } from './map_copy.ts';
import { Raster, geometryOf } from './raster.ts';
import type { CellRect, Geometry } from './raster.ts';
import { MapLayer } from './wire/plumescout/v1/map_service_pb.ts';
import type { MapStatus } from './wire/plumescout/v1/map_service_pb.ts';

export type LinkState = 'connecting' | 'live' | 'waiting' | 'hidden' | 'ended';

export type WatchEvents = {
  // The map is another one: draw all of it.
  replaced(raster: Raster): void;
  // Cells of it changed.
  changed(rects: CellRect[]): void;
  status(status: MapStatus, revision: bigint): void;
  link(state: LinkState, trouble: Trouble | null, again_s: number): void;
};

const ALL_LAYERS = [MapLayer.OCCUPANCY, MapLayer.GAS_MEAN, MapLayer.GAS_VARIANCE];
const FIRST_PAUSE_S = 0.5;
const LONGEST_PAUSE_S = 10;
// Streams of a tab that nobody sees are given up after this.
const HIDDEN_PATIENCE_MS = 5_000;

export type Replay = { fromRevision: bigint; speed: number };

export class Watch {
  private stopped = false;
  private abort = new AbortController();
  private hiddenTimer = 0;
  private hidden = document.hidden; // for so long that no stream is held
  private level = 0;
  private wake: () => void = () => {};

  constructor(private readonly mission: string, private readonly events: WatchEvents,
              private readonly replay: Replay | null = null) {
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
    this.wake();
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

  private pause(seconds: number): Promise<void> {
    return new Promise((resolve) => {
      const timer = window.setTimeout(resolve, seconds * 1000);
      this.wake = () => {
        window.clearTimeout(timer);
        resolve();
      };
    });
  }

  private async run(): Promise<void> {
    let pause_s = FIRST_PAUSE_S;
    while (!this.stopped) {
      if (this.hidden) {
        this.events.link('hidden', null, 0);
        await this.pause(1e6);
        continue;
      }
      this.abort = new AbortController();
      this.events.link('connecting', null, 0);
      let trouble: Trouble | null = null;
      try {
        await this.read(() => { pause_s = FIRST_PAUSE_S; });
      } catch (error) {
        trouble = troubleOf(error);
      }
      if (this.stopped) return;
      if (this.abort.signal.aborted) continue; // hidden, or it begins again at another level
      if (trouble?.code === Code.NotFound || trouble?.code === Code.PermissionDenied ||
          trouble?.code === Code.Unauthenticated || trouble?.code === Code.OutOfRange) {
        this.events.link('ended', trouble, 0);
        return;
      }
      this.events.link('waiting', trouble, pause_s);
      await this.pause(pause_s);
      pause_s = Math.min(2 * pause_s, LONGEST_PAUSE_S);
    }
  }

  private async read(received: () => void): Promise<void> {
    const copy = new MapCopy();
    const stream = maps.watchMap({
      mission: this.mission,
      layers: ALL_LAYERS,
      levelOfDetail: this.level,
      ...(this.replay === null ? {}
        : { fromRevision: this.replay.fromRevision, speedRatio: this.replay.speed }),
    }, { signal: this.abort.signal });
    let rects: CellRect[] = [];
    let all = false;
    for await (const frame of stream) {
      received();
      if (this.stopped) return;
      const geometry: Geometry | null = geometryOf(frame.status?.geometry);
      if (geometry !== null && levelFor(geometry.columns * geometry.rows) > this.level) {
        this.level = levelFor(geometry.columns * geometry.rows);
        this.abort.abort();
        return;
      }
      const drawn = copy.apply(frame);
      if (drawn === 'all') all = true;
      else rects.push(...drawn);
      if (frame.status !== undefined) this.events.status(frame.status, frame.revision);
      if (frame.moreFollow) continue;
      if (all && copy.raster !== null) this.events.replaced(copy.raster);
      else if (rects.length > 0) this.events.changed(rects);
      all = false;
      rects = [];
      this.events.link('live', null, 0);
    }
  }
}

// The map as it was, or as it is (revision 0); of one with more cells than a page holds, squares of cells.
export async function fetchMap(mission: string, revision: bigint, signal: AbortSignal,
                               level = 0): Promise<{ raster: Raster; status: MapStatus }> {
  let raster: Raster | null = null;
  let status: MapStatus | undefined;
  let partToken = '';
  do {
    const part = await maps.getMap({ mission, layers: ALL_LAYERS, revision, partToken, levelOfDetail: level },
                                   { signal });
    status ??= part.status;
    const full = geometryOf(part.status?.geometry);
    const needed = full === null ? 0 : levelFor(full.columns * full.rows);
    if (needed > level) return fetchMap(mission, revision, signal, needed);
    const geometry = geometryOf(part.tileGeometry) ?? geometryOf(part.status?.geometry);
    if (raster === null && geometry !== null) raster = new Raster(geometry);
    if (raster !== null) for (const tile of part.tiles) raster.apply(tile);
    partToken = part.nextPartToken;
  } while (partToken !== '');
  if (raster === null || status === undefined) throw new Error('the mission had no map yet');
  return { raster, status };
}
