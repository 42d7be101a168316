// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The figures that a mission had before the page was opened, from its journal.
import { figuresOf, watchMap } from '@plumescout/client';
import type { MapUpdate } from '@plumescout/client';
import { client } from './client.ts';
import { isFirst } from './gases.ts';
import type { Gases } from './gases.ts';
import type { MissionClock } from './mission_clock.ts';
import { missionFigures } from './mission_figures.ts';
import type { MissionFigure } from './mission_figures.ts';

// All of it is shown in about so long, if the server can.
const SHOWN_IN_S = 10;
const SLOWEST = 60; // times as fast as it happened

export type PastFigures = { t_s: number; figures: MissionFigure[] };

export const speedOf = (length_s: number) => Math.max(SLOWEST, length_s / SHOWN_IN_S);

export function replayOf(mission: string, length_s: number, { looked }: Gases, signal: AbortSignal): AsyncIterable<MapUpdate> {
  return watchMap(client, mission, { fromRevision: 0n, speedRatio: speedOf(length_s), signal,
    ...(looked === '' ? {} : { species: looked }) });
}

// Of the frames of `updates` that are older than revision `until`.
export async function* pastFigures(updates: AsyncIterable<MapUpdate>, until: bigint, gases: Gases,
                                   clock: Pick<MissionClock, 'elapsed_s'>): AsyncGenerator<PastFigures, void> {
  for await (const { raster, status, revision } of updates) {
    if (revision >= until) return;
    if (raster === null) continue;
    const found = missionFigures(
      { figures: figuresOf(raster, isFirst(gases) ? status.gasThresholdPpm : 0), status, gases }, [], []);
    const t_s = await clock.elapsed_s(revision);
    if (t_s !== null) yield { t_s, figures: found };
  }
}
