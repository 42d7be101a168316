// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Which of several servers behind one address has a mission, as far as they have told.
import { Code, ConnectError } from '@connectrpc/connect';
import type { StreamResponse, Transport } from '@connectrpc/connect';
import type { DescMessage } from '@bufbuild/protobuf';
import { errorOf } from './errors.ts';

const MAX_REDIRECTS = 3; // beyond them who made the call waits, as for a server that is not there
const MAX_MISSIONS = 4096; // beyond them all is forgotten: it is a hint
const WORD = /^[!-~]{1,128}$/; // what headers may say
// Of a server that does not serve, or is not there.
const GONE_REASONS = ['', 'DRAINING', 'FENCED', 'STORE_UNAVAILABLE'];
const GONE = [Code.Unavailable, Code.Unknown, Code.Internal, Code.DeadlineExceeded];

/** The ID of the mission that a request is about, as it is named in it; '' of one that is about none. */
export function missionOf(request: unknown): string {
  if (typeof request !== 'object' || request === null) return '';
  const fields = request as Record<string, unknown>;
  const frame = fields['frame'] as { case?: unknown; value?: unknown } | undefined; // of an ingest stream
  if (frame?.case === 'open') return missionOf(frame.value);
  const target = fields['target'] as { value?: unknown } | undefined; // of an order to robots
  for (const value of [...['mission', 'name', 'robot', 'missionId', 'open'].map((name) => fields[name]), target?.value]) {
    const mission = typeof value === 'string' ? value : missionOf(value);
    if (mission !== '') return mission.replace(/^missions\//, '').split('/')[0]!;
  }
  return '';
}

class Routes {
  private readonly nodes = new Map<string, string>();

  // What a front finds a server by, of a try of a call; and the server, if one is known.
  address(mission: string, header?: HeadersInit): { headers: Headers; node: string } {
    const headers = new Headers(header);
    if (!WORD.test(mission)) return { headers, node: '' };
    headers.set('x-mission-id', mission);
    const node = this.nodes.get(mission) ?? '';
    if (node !== '') headers.set('x-node', node);
    return { headers, node };
  }

  // Whether another server than `node` has the mission: the call may be made again at once.
  note(mission: string, node: string, failed: unknown): boolean {
    if (!(failed instanceof ConnectError) || mission === '') return false;
    const { code, reason } = errorOf(failed);
    if (reason === 'MISSION_ELSEWHERE') {
      const owner = failed.metadata.get('x-owner') ?? '';
      if (!WORD.test(owner) || owner === node) return false;
      if (this.nodes.size >= MAX_MISSIONS && !this.nodes.has(mission)) this.nodes.clear();
      this.nodes.set(mission, owner);
      return true;
    }
    const gone = GONE.includes(code) && GONE_REASONS.includes(reason);
    if (gone && this.nodes.get(mission) === node) this.nodes.delete(mission);
    return false;
  }
}

/** Calls say which mission they are about, and go to the server that has it. Of a stream of requests
 * those that were sent are gone: whoever makes it makes it again, and it goes there. */
export function routed(transport: Transport): Transport {
  const routes = new Routes();
  return {
    async unary(method, signal, timeoutMs, header, input, contextValues) {
      const mission = missionOf(input);
      for (let left = MAX_REDIRECTS; ; --left) {
        const { headers, node } = routes.address(mission, header);
        try {
          return await transport.unary(method, signal, timeoutMs, headers, input, contextValues);
        } catch (failed) {
          if (!routes.note(mission, node, failed) || left === 0) throw failed;
        }
      }
    },
    async stream(method, signal, timeoutMs, header, input, contextValues) {
      const [first, requests] = await peeked(input);
      const mission = missionOf(first);
      let left = method.methodKind === 'server_streaming' ? MAX_REDIRECTS : 0;
      let node = '';
      const open = () => {
        const addressed = routes.address(mission, header);
        node = addressed.node;
        return transport.stream(method, signal, timeoutMs, addressed.headers,
                                left === 0 ? requests : only(first!), contextValues);
      };
      const isElsewhere = (failed: unknown) => routes.note(mission, node, failed) && left-- > 0;
      const response = await begun(open, isElsewhere);
      return { ...response, message: read(response, open, isElsewhere) };
    },
  };

  async function begun<R>(open: () => Promise<R>, isElsewhere: (failed: unknown) => boolean): Promise<R> {
    for (;;) {
      try {
        return await open();
      } catch (failed) {
        if (!isElsewhere(failed)) throw failed;
      }
    }
  }

  async function* read<I extends DescMessage, O extends DescMessage>(
    response: StreamResponse<I, O>, open: () => Promise<StreamResponse<I, O>>,
    isElsewhere: (failed: unknown) => boolean): StreamResponse<I, O>['message'] & AsyncGenerator {
    let opened = response, any = false;
    for (;;) {
      try {
        for await (const message of opened.message) {
          any = true;
          yield message;
        }
        return;
      } catch (failed) {
        if (!isElsewhere(failed) || any) throw failed;
      }
      opened = await begun(open, isElsewhere);
    }
  }
}

async function* only<T>(one: T): AsyncGenerator<T> {
  yield one;
}

// The first of them, and all of them.
async function peeked<T>(items: AsyncIterable<T>): Promise<[T | undefined, AsyncIterable<T>]> {
  const iterator = items[Symbol.asyncIterator]();
  const first = await iterator.next();
  return [first.value as T | undefined, (async function* () {
    try {
      for (let item = first; item.done !== true; item = await iterator.next()) yield item.value;
    } finally {
      await iterator.return?.();
    }
  })()];
}
