// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What a report page draws, as it stands in the page: written by plumescout-lab, or by the console.
import { Raster, geometryOf } from '@plumescout/client';
import type { GetMapResponse } from '@plumescout/client/wire';

export type ReportedMission = {
  title?: string; // of a page that stands by itself
  map: string; // GetMapResponse in base64, as the others
  truth?: string; // absent: nobody knows
  plans: { time_s?: number; plan: string }[]; // robot by robot; time_s: of the mission's begin
  ways: { robot: string; points_m: [number, number][] }[];
  homes_m: [number, number][];
  sources_m: [number, number][];
  // `asked`: ObjectiveOptions; `verdicts`: one of the wire's ObjectiveVerdict a cell, a byte each, row by
  // row from the south. Null: a complete map.
  objective: { asked: string; verdicts: string } | null;
};

const PLACE = '@mission@';

// `page` with the mission in its place.
export function fillReport(page: string, mission: ReportedMission): string {
  const [before, ...after] = page.split(PLACE);
  if (after.length === 0) throw new Error('the server has no page for reports: build it with scripts/console');
  // Nothing ends the script that it stands in.
  return [before + JSON.stringify(mission).replaceAll('<', '\\u003c') + after[0], ...after.slice(1)].join(PLACE);
}

const BLOCK = 0x8000; // arguments that a call takes

export function base64Of(bytes: Uint8Array): string {
  let letters = '';
  for (let i = 0; i < bytes.length; i += BLOCK) letters += String.fromCharCode(...bytes.subarray(i, i + BLOCK));
  return btoa(letters);
}
export function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}

// Null: there is no map yet.
export function rasterOf(response: GetMapResponse): Raster | null {
  const geometry = geometryOf(response.tileGeometry);
  if (geometry === null) return null;
  const raster = new Raster(geometry);
  for (const tile of response.tiles) raster.apply(tile);
  return raster;
}
