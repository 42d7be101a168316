// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The figures that a mission had before the page was opened: the server replays its journal for them,
// once for all pages.
import { Code, errorOf } from '@plumescout/client';
import type { GetMissionFiguresResponse, MissionFigures } from '@plumescout/client/wire';

// Between looks at what the server has found so far.
const PERIOD_S = 1;
// Between attempts, where the server is short of something; then it is left alone.
const RETRY_AFTER_S = [1, 2, 4, 8, 15];
const PASSES = [Code.Unavailable, Code.ResourceExhausted, Code.DeadlineExceeded];

export type Ask = () => Promise<Pick<GetMissionFiguresResponse, 'figures' | 'moreFollow'>>;

export const pause = (wait_s: number) => new Promise<void>((done) => { setTimeout(done, 1000 * wait_s); });

// All that was found so far, again and again until it is whole. Errors are those of the call.
export async function* pastFigures(ask: Ask, signal: AbortSignal,
                                   wait = pause): AsyncGenerator<MissionFigures[], void> {
  let found = 0;
  let failures = 0;
  while (!signal.aborted) {
    let wait_s = PERIOD_S;
    try {
      const { figures, moreFollow } = await ask();
      if (signal.aborted) return;
      if (figures.length > found) failures = 0;
      found = figures.length;
      yield figures;
      if (!moreFollow) return;
    } catch (error) {
      const { code, retryAfter_s } = errorOf(error);
      if (!PASSES.includes(code) || failures === RETRY_AFTER_S.length) throw error;
      wait_s = Math.max(RETRY_AFTER_S[failures++], retryAfter_s);
    }
    await wait(wait_s);
  }
}
