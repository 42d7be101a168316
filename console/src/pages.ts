// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The pages beside that of a mission: all missions, a new one, the service.
import { create, toBinary } from '@bufbuild/protobuf';
import { all } from '@plumescout/client';
import { PATIENCE, checkSize, missions, requestId, robots, sentence, token, troubleOf } from './client.ts';
import { ask, fill, fillIfChanged, h, notice } from './dom.ts';
import { optionsForm } from './options_form.ts';
import { robotsInShort } from './robots_panel.ts';
import { mayOperate, refreshSession, session } from './session.ts';
import { CreateMissionRequestSchema, MissionState } from '@plumescout/client/wire';
import type { Latency, Mission } from '@plumescout/client/wire';
import { bytes, duration, figure, missionState, phase, shortName, storeFacts } from './words.ts';

export type Page = { element: HTMLElement; leave(): void };

// Runs at once and then every so often, never twice at a time.
export function every(period_ms: number, task: () => Promise<void>): () => void {
  let timer = 0;
  let stopped = false;
  const run = async () => {
    if (!document.hidden) await task().catch(() => {});
    if (!stopped) timer = window.setTimeout(run, period_ms);
  };
  void run();
  return () => {
    stopped = true;
    clearTimeout(timer);
  };
}

export function trouble(error: unknown): HTMLElement {
  const what = troubleOf(error);
  return h('div', { class: 'trouble', role: 'alert' }, h('strong', {}, what.text),
    what.advice === '' ? null : h('div', {}, what.advice));
}

export function stateClass(state: MissionState): string {
  if (state === MissionState.RUNNING) return 'pill good';
  return state === MissionState.DAMAGED ? 'pill bad' : 'pill warn';
}

const allMissions = () => all(
  (pageToken) => missions.listMissions({ pageToken }, PATIENCE), (page) => page.missions);

async function deleteMission(name: string): Promise<void> {
  const sure = await ask(`Delete ${shortName(name)}?`,
    'The mission and all it holds are gone for good: its map, its readings, its history.', 'Delete');
  if (!sure) return;
  try {
    await missions.deleteMission({ name }, PATIENCE);
    notice(`${shortName(name)} is deleted.`);
  } catch (error) {
    notice(sentence(error), 'bad');
  }
}

function missionTable(list: Mission[]): HTMLElement {
  return h('div', { class: 'card scroll', tabindex: 0 }, h('table', {},
    h('thead', {}, h('tr', {}, h('th', {}, 'Mission'), h('th', {}, 'State'), h('th', {}, 'Phase'),
      h('th', { class: 'n' }, 'Robots'), h('th', { class: 'n' }, 'Revision'),
      h('th', {}, 'Strategy'), h('th', { class: 'n' }, 'Memory'), h('th', {}, 'Owner'), h('th', {}, ''))),
    h('tbody', {}, ...list.map((mission) => h('tr', {},
      h('td', {}, h('a', { href: `#/${mission.name}` }, shortName(mission.name))),
      h('td', {}, h('span', { class: stateClass(mission.state) }, missionState(mission.state)),
        mission.state === MissionState.ELSEWHERE ? ` on ${mission.node}` : null),
      h('td', {}, phase(mission.phase)),
      h('td', { class: 'n' }, mission.robotCount),
      h('td', { class: 'n' }, String(mission.revision)),
      h('td', {}, mission.options?.planning?.strategy ?? '–'),
      h('td', { class: 'n' }, bytes(mission.memory?.usedBytes ?? 0)),
      h('td', {}, mission.owner),
      h('td', {}, mayOperate()
        ? h('button', { class: 'danger', 'aria-label': `Delete ${shortName(mission.name)}`,
                        onclick: () => void deleteMission(mission.name) }, 'Delete')
        : null))))));
}

export function listPage(): Page {
  const body = h('div', {}, h('p', { class: 'empty' }, 'Loading missions …'));
  const newLink = h('a', { href: '#/new' }, 'New mission');
  newLink.hidden = !mayOperate();
  const element = h('main', { class: 'sheet' },
    h('div', { class: 'row' }, h('h1', {}, 'Missions'), h('span', { class: 'spring' }), newLink), body);
  const stop = every(1500, async () => {
    try {
      if (session.info === null) await refreshSession();
      newLink.hidden = !mayOperate();
      const list = await allMissions();
      const key = JSON.stringify([mayOperate(), list.map((one) => [one.name, one.state, one.phase,
        one.robotCount, String(one.revision), String(one.memory?.usedBytes)])]);
      fillIfChanged(body, key, () => [list.length > 0 ? missionTable(list)
        : h('div', { class: 'card empty' }, h('p', {}, 'No mission yet.'),
            mayOperate() ? h('p', {}, 'Make one with ', h('a', { href: '#/new' }, 'New mission'),
              ', or let scripts/demo --console drive a simulated robot.') : null)]);
    } catch (error) {
      fillIfChanged(body, sentence(error), () => [trouble(error)]);
    }
  });
  return { element, leave: stop };
}

export function newPage(): Page {
  const id = h('input', { id: 'mission-id', required: true, placeholder: 'hall-3', autocomplete: 'off',
                          pattern: '[a-z]([a-z0-9\\-]{0,61}[a-z0-9])?' });
  const options = optionsForm();
  options.element.setAttribute('open', '');
  const failed = h('div', {});
  const form = h('form', { class: 'grid card', onsubmit: async (event: SubmitEvent) => {
    event.preventDefault();
    fill(failed);
    try {
      const request = create(CreateMissionRequestSchema, {
        missionId: id.value, options: await options.read(), requestId: requestId() });
      const info = session.info ?? await refreshSession();
      checkSize(toBinary(CreateMissionRequestSchema, request).length, Number(info.limits?.maxReceiveBytes ?? 0));
      const made = await missions.createMission(request, PATIENCE);
      location.hash = `#/${made.mission?.name ?? ''}`;
    } catch (error) {
      fill(failed, trouble(error));
      failed.scrollIntoView({ block: 'nearest' });
    }
  } },
    h('div', { class: 'field' }, h('label', { for: 'mission-id' }, 'Name'), id,
      h('small', {}, 'Small letters, digits and hyphens; it begins with a letter.')),
    options.element, failed,
    h('div', { class: 'row end' }, h('a', { href: '#/' }, 'Cancel'),
      h('button', { class: 'primary' }, 'Create mission')));
  return { element: h('main', { class: 'sheet' }, h('h1', {}, 'New mission'), form), leave: () => {} };
}

function facts(pairs: [string, string | number][]): HTMLElement {
  return h('dl', { class: 'facts' },
    ...pairs.flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value)]));
}

function latency(of: Latency | undefined, value_s: number | undefined): string {
  return of === undefined || of.sampleCount === 0n ? '–' : `${figure(1000 * (value_s ?? NaN))} ms`;
}

// Missions whose robots are asked for every time.
const MOST_ASKED = 20;

// Those of missions that are awake; no question wakes one.
async function robotTable(list: Mission[]): Promise<HTMLElement> {
  const awake = list.filter((one) => one.robotCount > 0 && one.state !== MissionState.SLEEPING);
  const asked = awake.slice(0, MOST_ASKED);
  const rows = await Promise.all(asked.map(async ({ name }) => {
    const answer = await robots.listRobots({ mission: name }, PATIENCE).catch(() => null); // it may be gone by now
    return answer === null ? null : h('tr', {}, h('td', {}, h('a', { href: `#/${name}` }, shortName(name))),
      ...robotsInShort(answer.robots).map((fact, i) => h('td', { class: i === 1 ? null : 'n' }, fact)));
  }));
  if (asked.length === 0) return h('p', { class: 'quiet' }, 'No robot in a mission that is awake.');
  return h('div', {}, h('table', {}, h('thead', {}, h('tr', {}, h('th', {}, 'Mission'), h('th', { class: 'n' }, 'Robots'),
    h('th', {}, 'Silent'), h('th', { class: 'n' }, 'Longest not heard for'), h('th', { class: 'n' }, 'Oldest newest sample'))),
    h('tbody', {}, ...rows)),
    awake.length > asked.length ? h('p', { class: 'quiet' }, `Of the first ${MOST_ASKED} of ${awake.length} missions.`) : null);
}

export function servicePage(): Page {
  const body = h('div', {}, h('p', { class: 'empty' }, 'Asking the server …'));
  const input = h('input', { type: 'password', id: 'token', autocomplete: 'off',
                             placeholder: token.get() === '' ? 'none' : 'set' });
  const form = h('form', { class: 'card', onsubmit: (event: Event) => {
    event.preventDefault();
    token.set(input.value.trim());
    notice(input.value === '' ? 'The token is forgotten.' : 'The token is used from now on.');
    input.value = '';
    session.info = null;
  } },
    h('h2', {}, 'Who you are'),
    h('label', { for: 'token' }, 'Token, kept until this tab is closed; empty: none'),
    h('div', { class: 'row' }, input, h('button', { class: 'primary' }, 'Use')));
  const stop = every(2000, async () => {
    try {
      const [info, list] = [await refreshSession(), await allMissions()];
      const robotsOfAll = await robotTable(list);
      const used = list.reduce((sum, one) => sum + Number(one.memory?.usedBytes ?? 0), 0);
      const budget = list.reduce((sum, one) => sum + Number(one.memory?.budgetBytes ?? 0), 0);
      const limits = info.limits;
      fill(body,
        h('div', { class: 'card' }, h('h2', {}, 'Server'), facts([
          ['version', info.version], ['running for', duration(Number(info.uptime?.seconds ?? 0))],
          ['boot id', info.bootId], ['parts', info.features.join(', ') || 'none beside the usual'],
          ['you', `${info.caller} (${info.callerRole})`]])),
        h('div', { class: 'card' }, h('h2', {}, 'Store'), facts(storeFacts(info.store))),
        h('div', { class: 'card' }, h('h2', {}, 'Room'), facts([
          ['missions', `${list.length} of ${limits?.maxMissionCount ?? '–'}`],
          ['memory in use', bytes(used)],
          ['memory promised to missions', `${bytes(budget)} of ${bytes(limits?.memoryBudgetBytes ?? 0)}`],
          ['largest request', bytes(limits?.maxReceiveBytes ?? 0)],
          ['longest planning', duration(Number(limits?.maxPlanningBudget?.seconds ?? 0))]])),
        h('div', { class: 'card scroll', tabindex: 0 }, h('h2', {}, 'Robots'), robotsOfAll),
        h('div', { class: 'card scroll', tabindex: 0 }, h('h2', {}, 'Gas posteriors'), list.length === 0
          ? h('p', { class: 'quiet' }, 'No mission yet.')
          : h('table', {}, h('thead', {}, h('tr', {}, h('th', {}, 'Mission'),
              h('th', { class: 'n' }, 'Update, median'), h('th', { class: 'n' }, 'of 100, 99 below'),
              h('th', { class: 'n' }, 'Reading to watcher, median'), h('th', { class: 'n' }, 'of 100, 99 below'))),
            h('tbody', {}, ...list.map((one) => h('tr', {}, h('td', {}, shortName(one.name)),
              ...[one.gasTimings?.update, one.gasTimings?.staleness].flatMap((time) => [
                h('td', { class: 'n' }, latency(time, time?.medianS)),
                h('td', { class: 'n' }, latency(time, time?.p99S))])))))));
    } catch (error) {
      fill(body, trouble(error));
    }
  });
  return { element: h('main', { class: 'sheet' }, h('h1', {}, 'Service'), form, body), leave: stop };
}
