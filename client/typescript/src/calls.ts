// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// How calls are made: in time, again if that may help, and once in effect.
import { Code } from '@connectrpc/connect';
import type { Interceptor, Transport } from '@connectrpc/connect';
import type { DescMethodUnary, MessageInitShape, DescMessage } from '@bufbuild/protobuf';
import { MethodOptions_IdempotencyLevel } from '@bufbuild/protobuf/wkt';
import { Backoff, pause } from './backoff.ts';
import type { BackoffOptions } from './backoff.ts';
import { errorOf } from './errors.ts';
import type { CallError } from './errors.ts';
import { routed } from './routes.ts';

export type CallOptions = {
  token?: string | (() => string); // a function is asked at every call
  timeout_s?: number; // of calls that name no time themselves, streams apart; 10
  retries?: boolean; // within that time, wait for a server that is not there or recovers; true
};

export const LINK_BACKOFF: BackoffOptions = { first_s: 0.1, longest_s: 2, factor: 1.6, jitter: 0.2 };

/** Names a request, so that it has its effect once. crypto.randomUUID is for secure origins alone, and
 * Node 18 has no crypto here. */
export function requestId(): string {
  const bytes = new Uint8Array(16);
  if (globalThis.crypto === undefined) bytes.forEach((_, i) => { bytes[i] = 256 * Math.random(); });
  else globalThis.crypto.getRandomValues(bytes);
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0')).join('');
}

export function identify(token: CallOptions['token'] = ''): Interceptor {
  return (next) => (request) => {
    const value = typeof token === 'string' ? token : token();
    if (value !== '') request.header.set('authorization', `Bearer ${value}`);
    return next(request);
  };
}

// Whether the call may be made again although the first may have been carried out.
function isRepeatable(method: DescMethodUnary): boolean {
  return method.idempotency !== MethodOptions_IdempotencyLevel.IDEMPOTENCY_UNKNOWN ||
    method.input.field.requestId !== undefined || /^(Get|List|Query|Check)/.test(method.name);
}

// Whether it has not been carried out, and will be once the server has recovered, or another one has
// the mission.
function passesByItself({ reason }: CallError): boolean {
  return ['RECOVERING', 'STORE_UNAVAILABLE', 'MISSION_ELSEWHERE', 'NODE_UNREACHED'].includes(reason);
}

// Whether nobody is there. A front says the latter two when the server behind it ends in mid-call.
function isSilence({ code, reason }: CallError): boolean {
  return code === Code.Unavailable ||
    (reason === '' && (code === Code.Unknown || code === Code.Internal));
}

function named<I extends DescMessage>(method: DescMethodUnary<I>,
                                      input: MessageInitShape<I>): MessageInitShape<I> {
  const given = input as { requestId?: string };
  if (method.input.field.requestId === undefined || (given.requestId ?? '') !== '') return input;
  return { ...input, requestId: requestId() };
}

/** Unary calls get a time, a name if they take one, and are made again within that time while the
 * server is not there. All go to the server that has their mission. */
export function patient(direct: Transport, { timeout_s = 10, retries = true }: CallOptions): Transport {
  const transport = routed(direct);
  return {
    stream: transport.stream.bind(transport),
    async unary(method, signal, timeoutMs, header, input, contextValues) {
      const end_ms = performance.now() + (timeoutMs ?? 1000 * timeout_s);
      const backoff = new Backoff(LINK_BACKOFF);
      const request = named(method, input);
      for (;;) {
        const left_ms = Math.max(1, Math.ceil(end_ms - performance.now())); // whole, for the wire
        try {
          return await transport.unary(method, signal, left_ms, header, request, contextValues);
        } catch (failed) {
          const error = errorOf(failed);
          const wait_s = Math.max(error.retryAfter_s, backoff.next_s());
          const again = retries && isSilence(error) &&
            (passesByItself(error) || isRepeatable(method));
          if (!again || signal?.aborted === true || performance.now() + 1000 * wait_s > end_ms) {
            throw failed;
          }
          await pause(wait_s, signal);
        }
      }
    },
  };
}
