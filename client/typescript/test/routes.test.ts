// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Code, ConnectError } from '@connectrpc/connect';
import type { HandlerContext } from '@connectrpc/connect';
import { missionOf } from '../src/routes.ts';
import { ErrorInfoSchema, IngestService, MissionService, RobotService } from '../src/wire/index.ts';
import { Timers, clientOf } from './support.ts';

const timers = new Timers();

// Nodes behind one address: a call goes to the one that it names, or else to n1. All missions are at
// `owner`; calls that come to `dead` end as a front ends them.
class Nodes {
  owner = 'n2';
  dead = '';
  death = Code.Unknown;
  private calls: string[] = [];

  readonly client = clientOf(({ service }) => {
    service(MissionService, { getMission: (_, context) => this.enter(context) });
    const nodes = this;
    service(RobotService, {
      async* watchRobot(_, context) {
        nodes.enter(context);
        yield {};
      },
    });
    service(IngestService, {
      async* streamObservations(requests, context) {
        nodes.enter(context);
        for await (const { frame } of requests) if (frame.case === 'open') yield {};
      },
    });
  });

  taken(): string[] {
    return this.calls.splice(0);
  }
  private enter({ requestHeader }: HandlerContext) {
    const named = requestHeader.get('x-node') ?? '';
    this.calls.push(`${requestHeader.get('x-mission-id') ?? ''}@${named}`);
    const node = named === '' ? 'n1' : named;
    if (node === this.dead) throw new ConnectError('No status received', this.death);
    if (node !== this.owner) {
      throw new ConnectError('it is elsewhere', Code.Unavailable, { 'x-owner': this.owner },
                             [{ desc: ErrorInfoSchema, value: { reason: 'MISSION_ELSEWHERE' } }]);
    }
    return {};
  }
}

const HOUSE = { name: 'missions/house' };

test('calls go where the mission is, and are remembered there', async () => {
  const nodes = new Nodes();
  await nodes.client.missions.getMission(HOUSE);
  await nodes.client.missions.getMission(HOUSE);
  await nodes.client.missions.getMission({ name: 'missions/yard' });
  assert.deepEqual(nodes.taken(), ['house@', 'house@n2', 'house@n2', 'yard@', 'yard@n2']);
});

test('a node that does not answer is forgotten', async () => {
  for (const death of [Code.Unknown, Code.Internal, Code.Unavailable]) {
    const nodes = new Nodes();
    await nodes.client.missions.getMission(HOUSE);
    nodes.taken();
    Object.assign(nodes, { owner: 'n1', dead: 'n2', death });
    const asked = nodes.client.missions.getMission(HOUSE);
    await timers.pass(1000);
    await asked;
    assert.deepEqual(nodes.taken(), ['house@n2', 'house@']);
  }
});

test('nodes that send a call round in circles are asked later', async () => {
  const nodes = new Nodes();
  nodes.owner = 'two words';
  const asked = nodes.client.missions.getMission(HOUSE, { timeoutMs: 1 });
  await assert.rejects(asked, (failed: ConnectError) => failed.code === Code.Unavailable);
  assert.deepEqual(nodes.taken(), ['house@']);
});

test('streams go there, too', async () => {
  const nodes = new Nodes();
  const robot = 'missions/house/robots/scout';
  let frames = 0;
  for await (const frame of nodes.client.robots.watchRobot({ robot })) frames += frame === undefined ? 0 : 1;
  assert.equal(frames, 1);
  assert.deepEqual(nodes.taken(), ['house@', 'house@n2']);
  nodes.owner = 'n3';
  const stream = async () => {
    const requests = async function* () {
      yield { frame: { case: 'open' as const, value: { robot } } };
    };
    for await (const _ of nodes.client.ingest.streamObservations(requests())) ++frames;
  };
  await assert.rejects(stream(), (failed: ConnectError) => failed.code === Code.Unavailable);
  await stream(); // its requests were gone; made again it goes there
  assert.equal(frames, 2);
  assert.deepEqual(nodes.taken(), ['house@n2', 'house@n3']);
});

test('the mission is found in every kind of request', () => {
  assert.equal(missionOf({ mission: 'missions/house', robotId: 'scout' }), 'house');
  assert.equal(missionOf({ missionId: 'house' }), 'house');
  assert.equal(missionOf({ mission: { name: 'missions/house' } }), 'house');
  assert.equal(missionOf({ open: { robot: 'missions/house/robots/scout' } }), 'house');
  assert.equal(missionOf({ target: { case: 'mission', value: 'missions/house' }, home: true }), 'house');
  assert.equal(missionOf({ pageSize: 3 }), '');
  assert.equal(missionOf(undefined), '');
});
