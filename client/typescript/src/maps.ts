// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Maps as typed arrays: as they are, as they were, and as they change.
import type { MessageInitShape } from '@bufbuild/protobuf';
import { OwnAbort } from './abort.ts';
import { Backoff, pause } from './backoff.ts';
import type { BackoffOptions } from './backoff.ts';
import type { Client } from './client.ts';
import { Code, errorOf, isFinal } from './errors.ts';
import type { CallError } from './errors.ts';
import { MAX_CELLS, MapCopy, levelFor } from './map_copy.ts';
import { Raster, geometryOf } from './raster.ts';
import type { CellRect } from './raster.ts';
import { MapLayer, WatchMapResponse_Kind } from './wire/index.ts';
import type { MapRegionSchema, MapStatus } from './wire/index.ts';

const ALL_LAYERS = [MapLayer.OCCUPANCY, MapLayer.GAS_MEAN, MapLayer.GAS_VARIANCE];
const MAP_ATTEMPTS = 5;
const WATCH_BACKOFF: BackoffOptions = { first_s: 0.5, longest_s: 10, factor: 2, jitter: 0.2 };

export type MapOptions = {
  layers?: MapLayer[]; // all
  fullPrecision?: boolean; // of gas: float32, else 16 bits a cell and layer
  species?: string; // which of the mission's gases; the first
  region?: MessageInitShape<typeof MapRegionSchema>; // all
  levelOfDetail?: number; // n: squares of 2^n by 2^n cells make one, 0 to 6; 0
  signal?: AbortSignal;
};

export type DecodedMap = {
  raster: Raster | null; // null: the mission has no map yet
  status: MapStatus;
  revision: bigint;
};

function requestOf(mission: string, options: MapOptions) {
  return {
    mission,
    layers: options.layers ?? ALL_LAYERS,
    fullPrecision: options.fullPrecision ?? false,
    species: options.species === undefined ? [] : [options.species],
    levelOfDetail: options.levelOfDetail ?? 0,
    ...(options.region === undefined ? {} : { region: options.region }),
  };
}

export type GetMapOptions = MapOptions & {
  revision?: bigint; // the map as it was then
  freshPosterior?: boolean; // bring the gas up to date first
  maxPartBytes?: number; // of tiles in one message; as many as the server sends
  maxCells?: number; // of larger maps squares of cells come; any
};

/** The map of missions/{mission}. Errors are those of MapService.GetMap. */
export async function getMap(client: Client, mission: string, options: GetMapOptions = {}): Promise<DecodedMap> {
  for (let attempt = 1; ; ++attempt) {
    try {
      return await getParts(client, mission, options);
    } catch (error) {
      if (errorOf(error).reason !== 'MAP_PARTS_GONE' || attempt === MAP_ATTEMPTS) throw error;
    }
  }
}

async function getParts(client: Client, mission: string, options: GetMapOptions): Promise<DecodedMap> {
  const call = options.signal === undefined ? {} : { signal: options.signal };
  const request = { ...requestOf(mission, options), revision: options.revision ?? 0n,
                    freshPosterior: options.freshPosterior ?? false, maxPartBytes: options.maxPartBytes ?? 0 };
  let map: DecodedMap | null = null;
  let partToken = '';
  do {
    const part = await client.maps.getMap({ ...request, partToken }, call);
    if (map === null) {
      if (part.status === undefined) throw new Error('the first part of a map has no status');
      const whole = geometryOf(part.status.geometry);
      const level = levelFor(whole === null ? 0 : whole.columns * whole.rows, options.maxCells ?? Infinity);
      if (level > request.levelOfDetail) {
        return getParts(client, mission, { ...options, levelOfDetail: level });
      }
      const geometry = geometryOf(part.tileGeometry) ?? whole;
      map = { raster: geometry === null ? null : new Raster(geometry), status: part.status,
              revision: part.revision };
    }
    for (const tile of part.tiles) map.raster?.apply(tile);
    partToken = part.nextPartToken;
  } while (partToken !== '');
  return map;
}

export type MapUpdate = DecodedMap & { changed: 'all' | CellRect[] };

/** connecting: asks; live: a map is here; waiting: the link broke, and is tried again. */
export type LinkState = 'connecting' | 'live' | 'waiting';

export type WatchMapOptions = MapOptions & {
  maxCells?: number; // of larger maps squares of cells come; 4 million, which take 36 MB
  fromRevision?: bigint; // show what happened since, then go on live
  speedRatio?: number; // how many times faster than it happened; 1
  onLink?: (state: LinkState, error: CallError | null, again_s: number) => void;
};

/** The map whenever it changes, for as long as the reader goes on or until the signal ends it. The
 * raster is one and the same, kept up to date: copy() what is to stay. A link that breaks is opened
 * again, and the next update is then of all cells. What cannot pass by itself is thrown, as NotFound
 * and PermissionDenied. */
export async function* watchMap(client: Client, mission: string,
                                options: WatchMapOptions = {}): AsyncGenerator<MapUpdate, void> {
  let callbackFailed = false;
  const tell = (...news: Parameters<NonNullable<WatchMapOptions['onLink']>>) => {
    callbackFailed = true;
    options.onLink?.(...news);
    callbackFailed = false;
  };
  const ended = () => options.signal?.aborted === true;
  const backoff = new Backoff(WATCH_BACKOFF);
  const asked = { ...options };
  while (!ended()) {
    tell('connecting', null, 0);
    const level = asked.levelOfDetail;
    let error: CallError | null = null;
    try {
      for await (const update of readStream(client, mission, asked)) {
        backoff.reset();
        if (asked.fromRevision !== undefined) asked.fromRevision = update.revision;
        yield update;
        tell('live', null, 0);
      }
      if (asked.levelOfDetail !== level) continue;
    } catch (failed) {
      if (callbackFailed) throw failed; // nothing that another stream would mend
      if (ended()) return;
      error = errorOf(failed);
      // A server that lost the last events has nothing to show from there on.
      const lost = error.code === Code.OutOfRange && asked.fromRevision !== options.fromRevision;
      if (lost) delete asked.fromRevision;
      else if (isFinal(error)) throw failed;
    }
    if (ended()) return;
    const again_s = Math.max(backoff.next_s(), error?.retryAfter_s ?? 0);
    tell('waiting', error, again_s);
    await pause(again_s, options.signal);
  }
}

// The updates of one stream. Ends early, with the level raised, when the map has too many cells.
async function* readStream(client: Client, mission: string,
                           options: WatchMapOptions): AsyncGenerator<MapUpdate, void> {
  const abort = new OwnAbort(options.signal);
  const replay = options.fromRevision === undefined ? {}
    : { fromRevision: options.fromRevision, speedRatio: options.speedRatio ?? 1 };
  const stream = client.maps.watchMap({ ...requestOf(mission, options), ...replay }, { signal: abort.signal });
  const copy = new MapCopy();
  let status: MapStatus | undefined;
  let changed: 'all' | CellRect[] = [];
  try {
    for await (const frame of stream) {
      const geometry = frame.status?.geometry;
      const level = levelFor((geometry?.columnCount ?? 0) * (geometry?.rowCount ?? 0),
                             options.maxCells ?? MAX_CELLS);
      if (level > (options.levelOfDetail ?? 0)) {
        options.levelOfDetail = level;
        return;
      }
      const drawn = copy.apply(frame);
      if (drawn === 'all' || changed === 'all') changed = 'all';
      else changed.push(...drawn);
      status = frame.status ?? status;
      if (frame.moreFollow || frame.kind === WatchMapResponse_Kind.RESET || status === undefined) continue;
      yield { raster: copy.raster, status, revision: frame.revision, changed };
      changed = [];
    }
  } finally {
    abort.end();
  }
}
