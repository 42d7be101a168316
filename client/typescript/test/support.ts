// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import { Code, ConnectError, createRouterTransport } from '@connectrpc/connect';
import type { ConnectRouter } from '@connectrpc/connect';
import { patient } from '../src/calls.ts';
import type { CallOptions } from '../src/calls.ts';
import { Client } from '../src/client.ts';
import { ErrorInfoSchema } from '../src/wire/index.ts';

// A client of a server in this process.
export function clientOf(routes: (router: ConnectRouter) => void, options: CallOptions = {}): Client {
  return new Client(patient(createRouterTransport(routes), options));
}

// An error of the server.
export function refusal(code: Code, reason = '', metadata: Record<string, string> = {}): ConnectError {
  return new ConnectError(`${reason}: as asked for`, code, undefined,
                          [{ desc: ErrorInfoSchema, value: { reason, metadata } }]);
}

// Until all that does not wait for timers has happened.
export async function settle(): Promise<void> {
  for (let i = 0; i < 50; ++i) await new Promise(setImmediate);
}

// Timers that are run by hand, from now on.
export class Timers {
  private readonly tasks = new Map<number, { task: () => void; delay_ms: number }>();
  private last = 0;

  constructor() {
    Object.assign(globalThis, {
      setTimeout: (task: () => void, delay_ms: number) => {
        this.tasks.set(++this.last, { task, delay_ms });
        return this.last;
      },
      clearTimeout: (timer: number) => { this.tasks.delete(timer); },
    });
  }
  // Runs those of at most this delay.
  async pass(delay_ms: number): Promise<void> {
    await settle();
    for (const [id, one] of [...this.tasks]) {
      if (one.delay_ms > delay_ms) continue;
      this.tasks.delete(id);
      one.task();
    }
    await settle();
  }
}
