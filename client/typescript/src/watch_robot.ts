// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import { OwnAbort } from './abort.ts';
import { Backoff, pause } from './backoff.ts';
import { LINK_BACKOFF } from './calls.ts';
import type { Client } from './client.ts';
import { Code, errorOf, isFinal } from './errors.ts';
import type { CallError } from './errors.ts';
import type { WatchRobotResponse } from './wire/index.ts';

export type RobotNotice = WatchRobotResponse['notice'];

// Whether the server said why, and would say so again.
function isAnswer({ code, reason }: CallError): boolean {
  return reason !== '' && code !== Code.Unavailable && code !== Code.ResourceExhausted;
}

/** What there is to know of missions/{mission}/robots/{robot} without having asked: how it stands, first
 * and after every change; that its plan does not stand any more; that it was given another. A link
 * that breaks is opened again. leaseToken: of the robot itself; absent: of an operator. What cannot
 * pass by itself is thrown, as a lease that another has taken (LEASE_SUPERSEDED). */
export async function* watchRobot(client: Client, robot: string,
                                  options: { leaseToken?: bigint; signal?: AbortSignal } = {},
                                  ): AsyncGenerator<RobotNotice, void> {
  const backoff = new Backoff(LINK_BACKOFF);
  const ended = () => options.signal?.aborted === true;
  while (!ended()) {
    let retryAfter_s = 0;
    const abort = new OwnAbort(options.signal);
    try {
      const request = { robot, leaseToken: options.leaseToken ?? 0n };
      for await (const { notice } of client.robots.watchRobot(request, { signal: abort.signal })) {
        backoff.reset();
        yield notice;
      }
    } catch (failed) {
      if (ended()) return;
      const error = errorOf(failed);
      if (isFinal(error) || isAnswer(error)) throw failed;
      retryAfter_s = error.retryAfter_s;
    } finally {
      abort.end();
    }
    await pause(Math.max(backoff.next_s(), retryAfter_s), options.signal);
  }
}
