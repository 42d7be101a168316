// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import { Code, ConnectError, createClient } from '@connectrpc/connect';
import type { Interceptor } from '@connectrpc/connect';
import { createGrpcWebTransport } from '@connectrpc/connect-web';
import { ErrorInfoSchema, BadRequestSchema } from './wire/google/rpc/error_details_pb.ts';
import { MapService } from './wire/plumescout/v1/map_service_pb.ts';
import { MissionService } from './wire/plumescout/v1/mission_service_pb.ts';
import { PlanningService } from './wire/plumescout/v1/planning_service_pb.ts';
import { RobotService } from './wire/plumescout/v1/robot_service_pb.ts';
import { SnapshotService } from './wire/plumescout/v1/snapshot_service_pb.ts';
import { SystemService } from './wire/plumescout/v1/system_service_pb.ts';
import { bytes } from './words.ts';

const TOKEN_KEY = 'plumescout.token';

// Kept for as long as the tab is open, and no longer.
export const token = {
  get: () => sessionStorage.getItem(TOKEN_KEY) ?? '',
  set: (value: string) => {
    if (value === '') sessionStorage.removeItem(TOKEN_KEY);
    else sessionStorage.setItem(TOKEN_KEY, value);
  },
};

const identify: Interceptor = (next) => (request) => {
  const value = token.get();
  if (value !== '') request.header.set('authorization', `Bearer ${value}`);
  return next(request);
};

const transport = createGrpcWebTransport({
  baseUrl: location.origin,
  interceptors: [identify],
});

export const missions = createClient(MissionService, transport);
export const robots = createClient(RobotService, transport);
export const maps = createClient(MapService, transport);
export const planning = createClient(PlanningService, transport);
export const snapshots = createClient(SnapshotService, transport);
export const system = createClient(SystemService, transport);

// Names a request, so that it has its effect once. crypto.randomUUID is for secure origins alone.
export function requestId(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) =>
    byte.toString(16).padStart(2, '0')).join('');
}

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
  if (!(error instanceof ConnectError)) {
    return { text: error instanceof Error ? error.message : String(error), advice: '', code: Code.Unknown,
             reason: '' };
  }
  const connect = error;
  const info = connect.findDetails(ErrorInfoSchema)[0];
  const bad = connect.findDetails(BadRequestSchema)[0]?.fieldViolations[0];
  if (connect.cause instanceof TypeError) { // of fetch: there was no answer
    return {
      text: 'The server does not answer.',
      advice: 'It may have stopped, or the link is down. The console tries again by itself.',
      code: Code.Unavailable, reason: '',
    };
  }
  if (connect.rawMessage === 'HTTP 413') { // told before the server reads it, so not as a status
    return { text: 'The request is larger than the server takes.', advice: SMALLER,
             code: Code.ResourceExhausted, reason: '' };
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
    text: bad !== undefined && bad.field !== '' && !connect.rawMessage.includes(bad.field)
      ? `${bad.field}: ${connect.rawMessage}` : connect.rawMessage,
    advice: advice[connect.code] ?? '',
    code: connect.code,
    reason: info?.reason ?? '',
  };
}

export function inWords({ text, advice }: Trouble): string {
  return advice === '' ? text : `${text}${/[.!?]$/.test(text) ? '' : '.'} ${advice}`;
}

export function sentence(error: unknown): string {
  return inWords(troubleOf(error));
}
