// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';

// The calls, of a page whose server answers all with `answer`.
async function client(answer: () => Response) {
  Object.assign(globalThis, {
    location: { origin: 'http://localhost' }, sessionStorage: { getItem: () => null },
    fetch: async () => answer(),
  });
  return import('../src/client.ts');
}

const MAP = { options: { priorMap: { map: { case: 'files' as const, value: { pgm: new Uint8Array(1 << 20) } } } } };

test('a request that is too large is told with both sizes', async () => {
  const { checkSize, sentence } = await client(() => new Response());
  const told = (size: number, limit: number) => {
    try {
      checkSize(size, limit);
      return '';
    } catch (error) {
      return sentence(error);
    }
  };
  assert.match(told(1 << 20, 1 << 18), /^The request is 1(\.0+)? MiB, and the server takes 256 kiB at most\. Choose /);
  assert.equal(told(1 << 18, 1 << 18), '');
  assert.equal(told(1 << 20, 0), '');
});

test('what a server or a front refuses by its size is told in words', async () => {
  const { missions, troubleOf } = await client(() => new Response('', { status: 413 }));
  await assert.rejects(missions.createMission(MAP), (error) => {
    const { text, advice } = troubleOf(error);
    assert.equal(text, 'The request is larger than the server takes.');
    assert.match(advice, /max_receive_bytes/);
    return true;
  });
});

test('a mission that is gone is told in words', async () => {
  const { missions, sentence } = await client(() => new Response('', { headers: {
    'content-type': 'application/grpc-web+proto', 'grpc-status': '5', 'grpc-message': 'MISSION_NOT_FOUND: missions/hall' } }));
  await assert.rejects(missions.createMission(MAP), (error) =>
    sentence(error) === 'There is no mission of this name. It may have been deleted.');
});

test('no answer is told as such', async () => {
  const { missions, troubleOf } = await client(() => { throw new TypeError('fetch failed'); });
  await assert.rejects(missions.createMission(MAP), (error) =>
    troubleOf(error).text === 'The server does not answer.');
});
