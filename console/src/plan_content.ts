// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A plan in words and tables: what it was chosen from, and what was left out.
import { h } from './dom.ts';
import type { Plan, RejectedGoal } from '@plumescout/client/wire';
import { GoalKind, RejectedGoal_Reason } from '@plumescout/client/wire';
import { duration, figure, goalKind, phase, reason, searchEnd, shortName, source } from './words.ts';

// `pointAt` is told which candidate the pointer is on; -1: none.
export function planContent(plan: Plan, pointAt: (candidate: number) => void): HTMLElement[] {
  const cpu_s = Number(plan.cpuDuration?.seconds ?? 0) + (plan.cpuDuration?.nanos ?? 0) * 1e-9;
  const parts: HTMLElement[] = [
    h('h2', {}, `Plan ${shortName(plan.name)} of ${shortName(plan.robot)}`),
    h('p', {}, plan.explanation),
    h('p', { class: 'quiet' }, `${phase(plan.phase)} · ${plan.strategy} · search ended: ` +
      `${searchEnd(plan.end)} · ${cpu_s > 0 ? `${duration(cpu_s)} of CPU · ` : ''}revision ${plan.beliefRevision}` +
      (plan.goalKept ? ' · it keeps its goal: no other is better by the margin' : '')),
  ];
  if (plan.candidates.length > 0) parts.push(candidates(plan, pointAt), columnHelp());
  if (plan.rejectedGoals.length > 0) parts.push(rejected(plan));
  if (plan.candidates.length + plan.rejectedGoals.length > 0) {
    parts.push(h('p', { class: 'quiet' }, 'On the map: a number is a goal of the table, a dashed line the way to it; × is a ' +
      'goal that was left out, but for those of too few cells.'));
  }
  return parts;
}

// Of all that a plan may tell of a goal.
function columnHelp(): HTMLElement {
  const columns = [['m, s', 'length of the way, and how long it takes'],
    ['nats', 'what readings on the way are expected to tell of the gas; ≤: at most'],
    ['reward', 'of all stops on the way'], ['cost', 'by which goals are compared, in cells'],
    ['ppm', 'mean gas along the way, as estimated'], ['mean info', 'mean information along the way, 0 to 1'],
    ['penalty', 'for information along the way, in cells'], ['by', 'what found the way']];
  return h('details', {}, h('summary', {}, 'What the figures say'), h('dl', { class: 'facts' },
    ...columns.flatMap(([name, what]) => [h('dt', {}, name), h('dd', {}, what)])));
}

// Two lines each, so that nothing is cut beside the map: by what it is compared, and what else is known.
function candidates(plan: Plan, pointAt: (candidate: number) => void): HTMLElement {
  const priced = plan.candidates.some((one) => one.expectedInformationNats !== undefined);
  const rewarded = plan.candidates.some((one) => one.reward !== undefined);
  const n = { class: 'n' };
  const heads = ['m', 's', ...(priced ? ['nats', 'nats/s'] : []), ...(rewarded ? ['reward'] : []), 'cost'];
  const bodies = plan.candidates.map((one, i) => {
    const nats = one.expectedInformationNats ?? one.expectedInformationBoundNats ?? NaN;
    const atMost = one.expectedInformationNats === undefined && !Number.isNaN(nats) ? '≤\u00a0' : '';
    const chosen = i === plan.chosenIndex;
    const terms = [figure(one.lengthM), figure(one.durationS),
      ...(priced ? [atMost + figure(nats), atMost + figure(nats / one.durationS)] : []),
      ...(rewarded ? [figure(one.reward ?? NaN)] : []), figure(one.cost)];
    return h('tbody', { onmouseenter: () => pointAt(i), onmouseleave: () => pointAt(-1) },
      h('tr', { class: chosen ? 'pick chosen' : 'pick', tabindex: 0, onfocus: () => pointAt(i), onblur: () => pointAt(-1) },
        h('td', {}, i + 1, chosen ? ' ✓' : ''), h('td', {}, goalKind(one.goal?.kind ?? GoalKind.UNSPECIFIED)),
        ...terms.map((term) => h('td', n, term))),
      h('tr', { class: 'more' }, h('td', {}),
        h('td', { colspan: 1 + terms.length }, `${figure(one.meanConcentrationPpm)} ppm · mean info ${figure(one.meanUcb)} · ` +
          `penalty ${figure(one.informationPenalty)} · by ${source(one.pathSource)}`)));
  });
  return h('div', {}, h('h3', {}, `${plan.candidates.length} goals it could drive to`),
    h('div', { class: 'scroll', tabindex: 0 }, h('table', { class: 'candidates' },
      h('thead', {}, h('tr', {}, h('th', {}, '#'), h('th', {}, 'goal'), ...heads.map((head) => h('th', n, head)))),
      ...bodies)));
}

function rejected(plan: Plan): HTMLElement {
  const groups = new Map<RejectedGoal_Reason, RejectedGoal[]>();
  for (const one of plan.rejectedGoals) groups.set(one.reason, [...groups.get(one.reason) ?? [], one]);
  return h('div', {}, h('h3', {}, `${plan.rejectedGoals.length} goals left out`),
    ...[...groups].map(([why, goals]) => h('details', { open: goals.length <= 3 },
      h('summary', {}, `${goals.length} × ${reason(why)}`),
      h('table', {}, h('tbody', {}, ...goals.map((one) => h('tr', {},
        h('td', {}, goalKind(one.goal?.kind ?? GoalKind.UNSPECIFIED)),
        h('td', { class: 'n' }, `${figure(one.goal?.position?.xM ?? NaN)}, ${figure(one.goal?.position?.yM ?? NaN)}`),
        h('td', {}, one.detail))))))));
}
