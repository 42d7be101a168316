// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Code, createRouterTransport } from '@connectrpc/connect';
import { identify, patient } from '../src/calls.ts';
import { Client, all } from '../src/client.ts';
import { MissionService } from '../src/wire/index.ts';
import { Timers, clientOf, refusal } from './support.ts';

const timers = new Timers();

test('a request is named, and keeps its name when it is made again', async () => {
  const names: string[] = [];
  const client = clientOf(({ service }) => service(MissionService, {
    createMission: ({ requestId }) => {
      names.push(requestId);
      if (names.length === 1) throw refusal(Code.Unavailable);
      return { mission: { name: 'missions/hall' } };
    },
  }));
  const made = client.missions.createMission({ missionId: 'hall' });
  await timers.pass(200);
  assert.equal((await made).mission?.name, 'missions/hall');
  assert.equal(names.length, 2);
  assert.equal(names[0], names[1]);
  assert.match(names[0]!, /^[0-9a-f]{32}$/);
  await client.missions.createMission({ missionId: 'hall', requestId: 'mine' });
  assert.equal(names[2], 'mine');
});

// How many tries a call makes that fails with `code` and `reason`, for ever.
async function triesOf(method: 'deleteMission' | 'getMission', code: Code, reason: string, retries = true) {
  let tries = 0;
  const fail = () => {
    ++tries;
    throw refusal(code, reason);
  };
  const client = clientOf(({ service }) => service(MissionService, { [method]: fail }), { retries, timeout_s: 100 });
  let failed = false;
  client.missions[method]({ name: 'missions/hall' }).catch(() => { failed = true; });
  for (let i = 0; i < 3; ++i) await timers.pass(5000);
  assert.equal(failed, tries === 1);
  return tries;
}

test('a call is made again if that may help, and does no harm', async () => {
  assert.equal(await triesOf('getMission', Code.Unavailable, ''), 4);
  assert.equal(await triesOf('deleteMission', Code.Unavailable, 'RECOVERING'), 4);
  assert.equal(await triesOf('deleteMission', Code.Unavailable, ''), 1); // it may have been deleted
  assert.equal(await triesOf('getMission', Code.NotFound, 'MISSION_NOT_FOUND'), 1);
  assert.equal(await triesOf('getMission', Code.Unavailable, '', false), 1);
});

test('a call that is out of time is not made again', async () => {
  let tries = 0;
  const client = clientOf(({ service }) => service(MissionService, {
    getMission: () => {
      ++tries;
      throw refusal(Code.Unavailable);
    },
  }), { timeout_s: 0.05 }); // the first pause is longer
  await assert.rejects(client.missions.getMission({ name: 'missions/hall' }));
  assert.equal(tries, 1);
});

test('calls carry the token of the moment', async () => {
  const seen: (string | null)[] = [];
  let token = '';
  const client = new Client(patient(createRouterTransport(({ service }) => service(MissionService, {
    getMission: (_, { requestHeader }) => {
      seen.push(requestHeader.get('authorization'));
      return {};
    },
  }), { transport: { interceptors: [identify(() => token)] } }), {}));
  await client.missions.getMission({});
  token = 'secret';
  await client.missions.getMission({});
  assert.deepEqual(seen, [null, 'Bearer secret']);
});

test('lists are read to their end', async () => {
  const client = clientOf(({ service }) => service(MissionService, {
    listMissions: ({ pageToken }) => (pageToken === ''
      ? { missions: [{ name: 'missions/a' }], nextPageToken: 'more' } : { missions: [{ name: 'missions/b' }] }),
  }));
  const missions = await all((pageToken) => client.missions.listMissions({ pageToken }), (page) => page.missions);
  assert.deepEqual(missions.map(({ name }) => name), ['missions/a', 'missions/b']);
});
