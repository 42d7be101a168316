// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What a mission was for and what came of it, in words and areas.
import type { Raster } from '@plumescout/client';
import { GasAtPointSchema, ObjectiveKind, ObjectiveStatus_State, ObjectiveVerdict } from '@plumescout/client/wire';
import type { ObjectiveOptions, ObjectiveStatus } from '@plumescout/client/wire';
import { create } from '@bufbuild/protobuf';
import { h } from './dom.ts';
import { outlookOf } from './objective_layer.ts';
import type { Outlook } from './objective_layer.ts';
import { duration, figure } from './words.ts';

const ppm = (asked: ObjectiveOptions | undefined) => `${figure(asked?.thresholdPpm ?? NaN)} ppm`;

// Verdicts that a mission can have, as they are called there.
export function outlooksOf(asked: ObjectiveOptions | undefined): [Outlook, string][] {
  // The server counts both as undecided.
  const rest: [Outlook, string][] = [['undecided', 'undecided, measured'], ['unmeasured', 'undecided, not measured']];
  switch (asked?.kind) {
    case ObjectiveKind.MAP_ABOVE_THRESHOLD:
      return [['above', `above ${ppm(asked)}`], ['below', `below ${ppm(asked)}`], ...rest];
    case ObjectiveKind.CONFIRM_CLEAN:
      return [['below', `below ${ppm(asked)}`], ['refuted', `above ${ppm(asked)}`], ...rest];
    case ObjectiveKind.FIND_SOURCES:
      return [['below', 'weaker than the source'], ['above', `weaker, but above ${ppm(asked)}`], ...rest];
    default: return rest;
  }
}

export function askedInWords(asked: ObjectiveOptions): string {
  const sure = `, ${figure(100 * (asked.confidence ?? NaN))} % sure`;
  switch (asked.kind) {
    case ObjectiveKind.MAP_ABOVE_THRESHOLD: return `map where there is more than ${ppm(asked)}${sure}`;
    case ObjectiveKind.CONFIRM_CLEAN: return `confirm that there is nowhere more than ${ppm(asked)}${sure}`;
    case ObjectiveKind.FIND_SOURCES: return `find the strongest place, if it is above ${ppm(asked)}${sure}`;
    default: return 'a complete map';
  }
}

const OUTCOMES: Record<number, string> = {
  [ObjectiveStatus_State.MET]: 'met', [ObjectiveStatus_State.REFUTED]: 'refuted',
  [ObjectiveStatus_State.CANNOT_BE_MET]: 'the mission ended before', [ObjectiveStatus_State.PURSUED]: 'still open' };

export type VerdictArea = { outlook: Outlook; name: string; area_m2: number; share: number };

// Of each verdict, of all cells that count; `verdicts` has one of the wire's a cell of the raster.
export function verdictAreas(asked: ObjectiveOptions, verdicts: Uint8Array, raster: Raster): VerdictArea[] {
  const counts = new Map<Outlook, number>();
  let all = 0;
  verdicts.forEach((verdict: ObjectiveVerdict, i) => {
    const at = create(GasAtPointSchema, { verdict, meanPpm: raster.mean_ppm[i] });
    const outlook = outlookOf(at, asked.thresholdPpm ?? NaN);
    if (outlook === null) return;
    counts.set(outlook, (counts.get(outlook) ?? 0) + 1);
    ++all;
  });
  const cell_m2 = raster.geometry.resolution_m ** 2;
  return outlooksOf(asked).map(([outlook, name]) => ({
    outlook, name, area_m2: (counts.get(outlook) ?? 0) * cell_m2, share: all === 0 ? 0 : (counts.get(outlook) ?? 0) / all }));
}

export function objectiveSummary(asked: ObjectiveOptions, status: ObjectiveStatus, areas: VerdictArea[]): HTMLElement {
  const concluded = [ObjectiveStatus_State.MET, ObjectiveStatus_State.REFUTED].includes(status.state);
  const facts: [string, string][] = [['outcome', OUTCOMES[status.state] ?? 'unknown'],
    [concluded ? 'confidence' : 'confidence, most doubtful place', `${figure(100 * status.confidence)} %`]];
  if ((asked.deadlineS ?? 0) > 0) facts.push(['deadline', `after ${duration(asked.deadlineS!)}`]);
  return h('section', { class: 'card objective' }, h('h2', {}, 'What it was for'), h('p', {}, askedInWords(asked)),
    h('dl', { class: 'facts' }, ...facts.flatMap(([key, value]) => [h('dt', {}, key), h('dd', {}, value)])),
    h('table', {}, h('thead', {}, h('tr', {}, h('th', {}, 'verdict'), h('th', { class: 'n' }, 'm²'),
      h('th', { class: 'n' }, '% of what counts'))),
      h('tbody', {}, ...areas.map(({ outlook, name, area_m2, share }) => h('tr', {},
        h('td', {}, h('span', { class: `mark m-${outlook}` }, name)),
        h('td', { class: 'n' }, figure(area_m2)), h('td', { class: 'n' }, figure(100 * share)))))),
    h('p', {}, status.explanation));
}
