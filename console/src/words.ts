// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Names of things, and figures, as people read them.
import {
  Candidate_PathSource, GoalKind, MissionPhase, MissionState, ObjectiveStatus_State, Plan_End, RejectedGoal_Reason,
  RobotLink,
} from '@plumescout/client/wire';
import type { ObjectiveStatus, StoreInfo } from '@plumescout/client/wire';
import type { LinkState } from './watch.ts';

// GAS_FRONTIER: gas frontier.
function plain(name: string | undefined): string {
  return (name ?? 'unknown').toLowerCase().replaceAll('_', ' ');
}

// As the legend calls them.
export const goalKind = (kind: GoalKind) =>
  kind === GoalKind.OCCUPANCY_FRONTIER ? 'map frontier' : plain(GoalKind[kind]);
export const phase = (value: MissionPhase) => plain(MissionPhase[value]);
export const missionState = (state: MissionState) => plain(MissionState[state]);
export const link = (value: RobotLink) => plain(RobotLink[value]);
export const source = (value: Candidate_PathSource) => plain(Candidate_PathSource[value]);

const ENDS: Record<number, string> = {
  [Plan_End.ALL_GOALS_REACHED]: 'every goal has a path',
  [Plan_End.QUEUE_EXHAUSTED]: 'the samples ran out before every goal had a path',
  [Plan_End.STOPPED]: 'its time was up',
  [Plan_End.NO_GOALS]: 'there was no goal to go to',
  [Plan_End.MISSION_COMPLETE]: 'the mission is complete',
  [Plan_End.START_OCCUPIED]: 'there is no way out from where the robot stands',
  [Plan_End.ALL_GOALS_REJECTED]: 'every goal was left out for a reason',
};
export const searchEnd = (end: Plan_End) => ENDS[end] ?? 'unknown';

const REASONS: Record<number, string> = {
  [RejectedGoal_Reason.UNREACHABLE]: 'no way leads there',
  [RejectedGoal_Reason.TOO_SMALL]: 'too few cells',
  [RejectedGoal_Reason.SET_ASIDE]: 'failed before, or visited without change',
  [RejectedGoal_Reason.CLAIMED]: 'another robot is on its way there',
  [RejectedGoal_Reason.NOT_DRAWN]: 'more goals than the limit',
  [RejectedGoal_Reason.TOO_CLOSE]: 'nearer than the minimum distance',
  [RejectedGoal_Reason.SEARCH_STOPPED]: 'time was up before a path was found',
  [RejectedGoal_Reason.OVER_BUDGET]: 'too little travel would be left to drive home',
  [RejectedGoal_Reason.KEPT_OUT]: 'in an area where nobody may drive',
  [RejectedGoal_Reason.GONE]: 'there is no such goal any more',
  [RejectedGoal_Reason.TRAFFIC]: 'another robot is on the way to it for too long',
  [RejectedGoal_Reason.OVER_DEADLINE]: 'the robot would not be home by the deadline',
};
export const reason = (value: RejectedGoal_Reason) => REASONS[value] ?? 'could be a goal';

// What became of an objective, and how that looks; nothing of a complete map.
export function objectiveWords(status: ObjectiveStatus | undefined): [string, string] {
  if (status === undefined) return ['', ''];
  const sure = `${figure(100 * status.confidence)} %`;
  switch (status.state) {
    case ObjectiveStatus_State.MET: return [`objective met, ${sure}`, 'pill good'];
    case ObjectiveStatus_State.REFUTED: return [`objective refuted, ${sure}`, 'pill bad'];
    case ObjectiveStatus_State.CANNOT_BE_MET: return ['objective not met', 'pill warn'];
    default: return [`objective: ${figure(status.undecidedAreaM2)} m² undecided`, 'pill'];
  }
}

// Why no plan of the robot is told; '': there may be one. `answered`: the server did, of now.
export function noPlanWords(robot: string, isLive: boolean, answered: boolean): string {
  if (!isLive) return 'Plans are told of now alone. Go back to live to see where robots drive, and why.';
  if (robot === '') return 'No robot yet.';
  return answered ? `${shortName(robot)} has not been given a plan since the server started.` : 'Asking the server …';
}

// Of a map that is shown or saved in squares of cells, how large they are; '': it is of cells.
export function squaresInWords(square_m: number, cell_m: number): string {
  const across = Math.round(square_m / cell_m);
  return across > 1 ? `squares of ${across} × ${across} cells` : '';
}

// What robots are told of as; '': as they are, on the map that is looked at.
export function robotsAsOf(isLive: boolean, answers: boolean): string {
  if (!answers) return 'Robots as the server last told of them:';
  return isLive ? '' : 'Robots as they are now:';
}

// Of the stream that a page looks through, with the looks of its pill. `plays`: what was, not what is.
export function linkWords(state: LinkState, plays: boolean, again_s: number): [string, string] {
  switch (state) {
    case 'connecting': return ['connecting', 'pill warn'];
    case 'live': return plays ? ['playing', 'pill warn'] : ['live', 'pill good'];
    case 'waiting': return [again_s > 0 ? `connection lost, again in ${Math.ceil(again_s)} s` : 'connection lost', 'pill bad'];
    case 'hidden': return ['asleep while hidden', 'pill'];
    case 'ended': return ['ended', 'pill bad'];
  }
}

// Last part of a resource name.
export const shortName = (name: string) => name.slice(name.lastIndexOf('/') + 1);

export function figure(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1000 && size < 1e7) return String(Math.round(value));
  if (size >= 1e7 || size < 0.001) return value.toExponential(1);
  return String(Number(value.toPrecision(digits)));
}

export function bytes(count: bigint | number): string {
  const value = Number(count);
  if (value >= 1 << 30) return `${figure(value / (1 << 30))} GiB`;
  if (value >= 1 << 20) return `${figure(value / (1 << 20))} MiB`;
  return value >= 1024 ? `${figure(value / 1024)} kiB` : `${value} B`;
}

export function duration(seconds: number): string {
  if (!Number.isFinite(seconds)) return '–';
  if (seconds < 1) return `${Math.round(1000 * seconds)} ms`;
  if (seconds < 120) return `${figure(seconds)} s`;
  if (seconds < 7200) return `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;
  return `${Math.floor(seconds / 3600)} h ${Math.round((seconds % 3600) / 60)} min`;
}

// Where missions are kept, and how that goes; a server of an earlier release tells nothing.
export function storeFacts(store: StoreInfo | undefined): [string, string][] {
  if (store === undefined) return [['kept', 'not told by this server']];
  if (store.engine === 'none') return [['kept', 'nowhere: missions are gone when the server ends']];
  const trouble = store.trouble === '' ? '' : `: ${store.trouble}`;
  return [
    ['kept', store.engine === 'sqlite' ? 'in files of the server (SQLite)' : `in a database (${store.engine})`],
    ...(store.node === '' ? [] : [['node', `${store.node} of ${store.cluster}`] as [string, string]]),
    ['state', store.available ? 'takes data' : `takes no data now${trouble}`],
    ['missions take up, as of a minute ago', store.storedBytes === 0n ? 'not counted yet' : bytes(store.storedBytes)],
    ['not durable yet', bytes(store.backlogBytes)]];
}
