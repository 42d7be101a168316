// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Why a robot drives where it does, and not elsewhere.
import { PATIENCE, planning, sentence } from './client.ts';
import { fill, fillIfChanged, h } from './dom.ts';
import type { Place } from './scene.ts';
import { planContent } from './plan_content.ts';
import type { CheckTrajectoryResponse, FrontierGoal, Plan, Pose2D } from '@plumescout/client/wire';
import { CellState, GoalKind, RejectedGoal_Reason } from '@plumescout/client/wire';
import { figure, goalKind, reason } from './words.ts';

// A click means a frontier this near.
const NEAR_M = 0.8;

export class WhyPanel {
  readonly element: HTMLElement;
  private readonly answer = h('div', { 'aria-live': 'polite' });
  private readonly plan = h('div', {});
  private asked = 0;

  constructor(private readonly pointAt: (candidate: number) => void) {
    this.element = h('div', {},
      h('p', { class: 'quiet' }, 'Click a frontier or a place on the map to ask why the robot does not go there.'),
      this.answer, this.plan);
  }

  // The latest plan of the robot that is looked at; null: there is `none`, in words. `basis`: by which gas
  // it was made, of several.
  show(robot: string, plan: Plan | null, none: string, basis: string): void {
    const key = `${robot} ${none} ${basis} ${plan?.name ?? ''} ${plan?.chosenIndex ?? ''} ${plan?.beliefRevision ?? ''}`;
    fillIfChanged(this.plan, key, () => [
      ...(plan === null ? [h('p', { class: 'empty' }, none)] : planContent(plan, this.pointAt)),
      basis === '' ? null : h('p', { class: 'quiet' }, basis)]);
  }

  clear(): void {
    ++this.asked;
    fill(this.answer);
  }

  // Why `robot`, which stands at `pose`, does not go there.
  async ask(robot: string, pose: Pose2D | undefined, at: Place,
            latestPlan: () => Promise<Plan | null>): Promise<void> {
    const mine = ++this.asked;
    const say = (...what: (Node | string)[]) => {
      if (mine !== this.asked) return;
      fill(this.answer, h('div', { class: 'card' },
        h('h3', {}, `Why not ${figure(at.x_m)}, ${figure(at.y_m)}?`), ...what));
    };
    if (robot === '' || pose === undefined) return say('No robot has told where it is.');
    say('Asking the server …');
    try {
      const { frontiers } = await planning.listFrontiers({ robot }, PATIENCE);
      const near = nearestFrontier(frontiers, at);
      if (near !== null) return say(...frontierAnswer(near, await latestPlan()));
      const check = await planning.checkTrajectory({ robot, subject: { case: 'path', value: {
        vertices: [{ xM: pose.xM, yM: pose.yM }, { xM: at.x_m, yM: at.y_m }],
        goalKind: GoalKind.RANDOM_FREE_SPACE } } }, PATIENCE);
      say(...placeAnswer(check));
    } catch (error) {
      say(sentence(error));
    }
  }
}

export function nearestFrontier(frontiers: FrontierGoal[], at: Place): FrontierGoal | null {
  let best: FrontierGoal | null = null;
  let least = NEAR_M;
  for (const frontier of frontiers) {
    for (const point of [frontier.goal?.centroid, frontier.goal?.position]) {
      if (point === undefined) continue;
      const distance = Math.hypot(point.xM - at.x_m, point.yM - at.y_m);
      if (distance >= least) continue;
      least = distance;
      best = frontier;
    }
  }
  return best;
}

function samePlace(a: FrontierGoal, plan: Plan, i: number): boolean {
  const [p, q] = [a.goal?.position, plan.candidates[i].goal?.position];
  return p !== undefined && q !== undefined && Math.hypot(p.xM - q.xM, p.yM - q.yM) < 0.5;
}

function frontierAnswer(frontier: FrontierGoal, plan: Plan | null): (Node | string)[] {
  const way = frontier.travelM === undefined ? 'no way leads there' : `${figure(frontier.travelM)} m to drive`;
  const what = h('p', {}, `A ${goalKind(frontier.goal?.kind ?? GoalKind.UNSPECIFIED)} of ` +
    `${frontier.goal?.frontierCellCount ?? 0} cells; ${way}.`);
  if (frontier.reason !== RejectedGoal_Reason.UNSPECIFIED) {
    return [what, h('strong', {}, `It is no goal now: ${reason(frontier.reason)}` +
      (frontier.detail === '' ? '.' : ` (${frontier.detail}).`))];
  }
  const index = plan?.candidates.findIndex((_, i) => samePlace(frontier, plan, i)) ?? -1;
  if (plan === null || index < 0) {
    return [what, h('strong', {}, 'It could be a goal; the latest plan did not consider it.')];
  }
  if (index === plan.chosenIndex) return [what, h('strong', {}, 'It is where the robot drives.')];
  const [mine, chosen] = [plan.candidates[index], plan.candidates[plan.chosenIndex]];
  const rate = (one: typeof mine) =>
    (one.expectedInformationNats ?? one.expectedInformationBoundNats ?? NaN) / one.durationS;
  const atMost = mine.expectedInformationNats === undefined ? 'at most ' : '';
  return [what, h('strong', {}, `It is candidate ${index + 1}; number ${plan.chosenIndex + 1} was better` +
    (chosen !== undefined && rate(chosen) > rate(mine)
      ? `: ${figure(rate(chosen))} against ${atMost}${figure(rate(mine))} nats a second.`
      : ', counting also what is unseen behind it, or what else the strategy weighs.'))];
}

const STATES: Record<number, string> = {
  [CellState.UNKNOWN]: 'a cell that is not known yet',
  [CellState.OCCUPIED]: 'something that stands there',
  [CellState.OFF_MAP]: 'the edge of the map',
  [CellState.FREE]: 'free space too near an obstacle, or kept out',
};

function placeAnswer(check: CheckTrajectoryResponse): (Node | string)[] {
  const parts: (Node | string)[] = [h('p', {}, 'No frontier is near. The straight way there:')];
  if (check.blockage !== undefined) {
    parts.push(h('strong', {}, `after ${figure(check.blockage.distanceM)} m it meets ` +
      `${STATES[check.blockage.state] ?? 'an obstacle'}. `));
  } else if (check.rest !== undefined) {
    parts.push(h('strong', {}, `free: ${figure(check.rest.lengthM)} m, ${figure(check.rest.durationS)} s` +
      (check.rest.expectedInformationNats === undefined ? '. '
        : `, ${figure(check.rest.expectedInformationNats)} nats to be learnt on it. `)));
  }
  if (check.rejectedGoal !== undefined) {
    parts.push(`As a goal: ${check.rejectedGoal.detail || reason(check.rejectedGoal.reason)}.`);
  }
  return parts;
}
