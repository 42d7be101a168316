// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What a call was refused for, for programs and for people.
import { Code, ConnectError } from '@connectrpc/connect';
import { BadRequestSchema, ErrorInfoSchema, RetryInfoSchema } from './wire/index.ts';

export { Code };

export type CallError = {
  code: Code;
  reason: string; // that programs act on, as LEASE_HELD; may be empty
  message: string; // in the server's words
  fields: string[]; // of the request that are wrong
  metadata: Record<string, string>; // facts by name
  retryAfter_s: number; // how long the server asks to be left alone; 0: it does not say
  unanswered: boolean; // the link broke, or nobody is there; the code is Unavailable then
};

// Browsers say so with a TypeError of fetch, Node with an error of the system or a stream that was reset.
function isOfLink({ cause, rawMessage }: ConnectError): boolean {
  return cause instanceof TypeError || typeof (cause as { code?: unknown } | undefined)?.code === 'string' ||
    rawMessage.startsWith('http/2 stream closed with error code CANCEL');
}

/** Of anything that is thrown; what is no error of a call has code Unknown. */
export function errorOf(error: unknown): CallError {
  const call = error instanceof ConnectError ? error : null;
  const info = call?.findDetails(ErrorInfoSchema)[0];
  const delay = call?.findDetails(RetryInfoSchema)[0]?.retryDelay;
  const unanswered = call !== null && isOfLink(call);
  return {
    code: unanswered ? Code.Unavailable : call?.code ?? Code.Unknown,
    reason: info?.reason ?? '',
    message: call?.rawMessage ?? (error instanceof Error ? error.message : String(error)),
    fields: call?.findDetails(BadRequestSchema)[0]?.fieldViolations.map(({ field }) => field) ?? [],
    metadata: info?.metadata ?? {},
    retryAfter_s: delay === undefined ? 0 : Number(delay.seconds) + delay.nanos * 1e-9,
    unanswered,
  };
}

const FINAL = [Code.InvalidArgument, Code.NotFound, Code.AlreadyExists, Code.PermissionDenied,
  Code.Unauthenticated, Code.OutOfRange, Code.Unimplemented, Code.Canceled]; // the last: of a closed client

/** Whether the same call will be refused for ever. */
export function isFinal({ code }: CallError): boolean {
  return FINAL.includes(code);
}
