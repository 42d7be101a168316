// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The robots of a mission, and what is known of it all.
import { fill, h } from './dom.ts';
import { countersOf, isFirst, ofGas } from './gases.ts';
import type { Scene } from './scene.ts';
import type { Mission, Point2D, Robot } from '@plumescout/client/wire';
import { duration, figure, link, robotsAsOf, shortName } from './words.ts';

type Facts = [string, string][];

function list(facts: Facts): HTMLElement {
  return h('dl', { class: 'facts' },
    ...facts.flatMap(([key, value]) => [h('dt', {}, key), h('dd', {}, value)]));
}

function factsOf(robot: Robot): Facts {
  const facts: Facts = [['link', link(robot.link)],
    ['last heard', robot.lastHeardAgeS === undefined ? 'never' : `${duration(robot.lastHeardAgeS)} ago`],
    ['log applied', String(robot.onMap?.appliedSequence ?? 0)]];
  const refused = robot.onMap?.rejectedObservationCount ?? 0n;
  if (refused > 0n) facts.push(['refused', String(refused)]);
  if (robot.ingestLagS !== undefined) facts.push(['newest sample', `${duration(robot.ingestLagS)} old`]);
  if (robot.batteryShare !== undefined) facts.push(['battery', `${figure(100 * robot.batteryShare)} %`]);
  if (robot.livePlan === '') return [...facts, ['plan', 'none']];
  const late_s = robot.latenessS < 0.05 ? '' : `, late by ${figure(robot.latenessS, 2)} s`;
  return [...facts, ['plan', shortName(robot.livePlan)],
    ['on its way', `${figure(robot.progressS, 2)} s${late_s}`]];
}

function missionFacts(mission: Mission, { figures, status, gases }: Scene): Facts {
  const gas = status === null ? undefined : countersOf(status, gases);
  const plume: Facts = isFirst(gases)
    ? [[`plume${ofGas(gases)}`, `${figure(figures?.plume_m2 ?? NaN)} m² above ${figure(status?.gasThresholdPpm ?? NaN)} ppm`]] : [];
  return [['known', `${figure(figures?.known_m2 ?? NaN)} m²`], ['free', `${figure(figures?.free_m2 ?? NaN)} m²`],
    [`largest gas mean${ofGas(gases)}`, `${figure(figures?.max_ppm ?? NaN)} ppm`],
    ...plume,
    [`readings${ofGas(gases)}`, `${gas?.inPosteriorCount ?? 0n} of ${gas?.readingCount ?? 0n} in the posterior`],
    ['frontiers', String(status?.frontiers.filter((one) => !one.tooSmall).length ?? 0)],
    ['strategy', mission.options?.planning?.strategy ?? '–']];
}

// Of all robots of a mission: how many there are, which are silent, the least recently heard, and the oldest newest sample.
export function robotsInShort(robots: Robot[]): [string, string, string, string] {
  const oldest = (ages_s: (number | undefined)[]) => {
    const known = ages_s.filter((age_s) => age_s !== undefined);
    return known.length === 0 ? '–' : duration(Math.max(...known));
  };
  const silent = robots.filter(({ onMap }) => onMap?.silent).map(({ onMap }) => shortName(onMap!.robot));
  return [String(robots.length), silent.join(', ') || 'none', oldest(robots.map((one) => one.lastHeardAgeS)),
    oldest(robots.map((one) => one.ingestLagS))];
}

// Each place once: robots may have one in common. `named`: by the mission.
export function homesOf(robots: Robot[], named: Point2D | undefined): Point2D[] {
  const all = [named, ...robots.map(({ home }) => home)].filter((home) => home !== undefined);
  return [...new Map(all.map((home) => [`${home.xM} ${home.yM}`, home])).values()];
}

export class RobotsPanel {
  readonly element = h('div', {}, h('p', { class: 'empty' }, 'Loading …'));

  constructor(private readonly choose: (robot: string) => void,
              private readonly colourOf: (robot: string) => string) {}

  // `past`: the revision that the map is of, null: it is live; `answers`: the server does.
  show(mission: Mission | null, robots: Robot[], scene: Scene, past: bigint | null, answers: boolean): void {
    if (mission === null) return;
    // A button that is pointed at, or about to be pressed, stays where it is.
    const focused = this.element.contains(document.activeElement)
      ? document.activeElement?.getAttribute('aria-label') : null;
    if (robots.length === 0) {
      return fill(this.element, h('p', { class: 'empty' }, 'No robot has registered yet. ',
        'A robot joins with RegisterRobot: see docs/robots.md.'));
    }
    const asOf = robotsAsOf(past === null, answers);
    fill(this.element, asOf === '' ? null : h('p', { class: answers ? 'quiet' : 'stale' }, asOf),
      ...robots.map((robot) => this.robot(robot, scene.robot)),
      h('section', {}, h('h3', {}, past === null ? 'Mission' : `Mission at revision ${past}`), list(missionFacts(mission, scene))));
    if (focused !== null && focused !== undefined) {
      this.element.querySelector<HTMLElement>(`[aria-label="${CSS.escape(focused)}"]`)?.focus();
    }
  }

  private robot(robot: Robot, chosen: string): HTMLElement {
    const name = robot.onMap?.robot ?? '';
    const looked = name === chosen;
    const swatch = h('span', { class: 'swatch' });
    swatch.style.background = this.colourOf(name);
    return h('div', { class: looked ? 'robot chosen' : 'robot' },
      h('div', { class: 'row' }, swatch, h('strong', { class: 'spring' }, shortName(name)),
        robot.orderedHome ? h('span', { class: 'pill warn' }, 'sent home') : null,
        robot.onMap?.frameSuspect ? h('span', { class: 'pill bad' }, 'lost') : null,
        robot.onMap?.silent ? h('span', { class: 'pill bad' }, 'silent') : null,
        h('button', { 'aria-pressed': String(looked), 'aria-label': `${looked ? 'looked at' : 'look at'}: ${shortName(name)}`,
                      onclick: () => this.choose(name) }, looked ? 'looked at' : 'look at')),
      list(factsOf(robot)));
  }
}
