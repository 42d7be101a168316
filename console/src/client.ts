// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import { Code, connect, errorOf, requestId } from '@plumescout/client';
import type { CallError } from '@plumescout/client';
import { bytes } from './words.ts';

export { requestId };

const TOKEN_KEY = 'plumescout.token';

// Kept for as long as the tab is open, and no longer.
export const token = {
  get: () => sessionStorage.getItem(TOKEN_KEY) ?? '',
  set: (value: string) => {
    if (value === '') sessionStorage.removeItem(TOKEN_KEY);
    else sessionStorage.setItem(TOKEN_KEY, value);
  },
};

// Pages ask again by themselves, and say at once what is the matter.
export const client = connect(location.origin, { token: token.get, retries: false });
export const { missions, robots, maps, planning, snapshots, system } = client;

// Of calls that people wait for.
export const PATIENCE = { timeoutMs: 15_000 };

export type Trouble = {
  text: string; // what happened
  advice: string; // what to do about it; may be empty
  code: Code;
  reason: string; // MISSION_PAUSED; may be empty
};

const SMALLER = 'Choose a map of fewer cells, or raise limits.max_receive_bytes of the server.';

// An error if a request of so many bytes is more than the server takes; a limit of 0 is not known.
export function checkSize(size_bytes: number, limit_bytes: number): void {
  if (limit_bytes === 0 || size_bytes <= limit_bytes) return;
  throw new Error(`The request is ${bytes(size_bytes)}, and the server takes ${bytes(limit_bytes)} at most. ${SMALLER}`);
}

// What went wrong, in words that say how to go on.
export function troubleOf(error: unknown): Trouble {
  return troubleOfCall(errorOf(error));
}

export function troubleOfCall({ code, reason, message, fields, unanswered }: CallError): Trouble {
  const field = fields[0] ?? '';
  if (unanswered) {
    return {
      text: 'The server does not answer.',
      advice: 'It may have stopped, or the link is down. The console tries again by itself.',
      code: Code.Unavailable, reason: '',
    };
  }
  if (message === 'HTTP 413') { // told before the server reads it, so not as a status
    return { text: 'The request is larger than the server takes.', advice: SMALLER,
             code: Code.ResourceExhausted, reason: '' };
  }
  if (code === Code.NotFound && message.startsWith('MISSION_NOT_FOUND')) {
    return { text: 'There is no mission of this name.', advice: 'It may have been deleted.', code, reason };
  }
  const advice: Partial<Record<Code, string>> = {
    [Code.Unauthenticated]: 'Enter a token under Service.',
    [Code.PermissionDenied]: 'Your role may not do this. Ask for an operator’s token.',
    [Code.NotFound]: 'It may have been deleted. Go back to the missions.',
    [Code.Unavailable]: 'The server is stopping, or is not ready. The console tries again by itself.',
    [Code.ResourceExhausted]: 'The server is busy. Try again in a moment.',
    [Code.DeadlineExceeded]: 'That took too long. Try again in a moment.',
  };
  return {
    text: field !== '' && !message.includes(field) ? `${field}: ${message}` : message,
    advice: advice[code] ?? '',
    code,
    reason,
  };
}

export function inWords({ text, advice }: Trouble): string {
  return advice === '' ? text : `${text}${/[.!?]$/.test(text) ? '' : '.'} ${advice}`;
}

export function sentence(error: unknown): string {
  return inWords(troubleOf(error));
}
