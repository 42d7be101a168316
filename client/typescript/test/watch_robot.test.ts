// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Code } from '@connectrpc/connect';
import { watchRobot } from '../src/watch_robot.ts';
import { RobotService } from '../src/wire/index.ts';
import { Timers, clientOf, refusal } from './support.ts';

const timers = new Timers();

test('what the server says for good ends the watch', async () => {
  for (const [code, reason] of [[Code.FailedPrecondition, 'MISSION_FINISHED'], [Code.NotFound, 'ROBOT_NOT_FOUND'],
    [Code.DataLoss, 'STORE_DAMAGED'], [Code.InvalidArgument, '']] as const) {
    let asked = 0;
    const client = clientOf(({ service }) => service(RobotService, {
      async* watchRobot() {
        ++asked;
        throw refusal(code, reason);
      },
    }));
    const watching = (async () => {
      for await (const _ of watchRobot(client, 'missions/hall/robots/scout')) assert.fail('nothing comes');
    })();
    await assert.rejects(watching, new RegExp(reason));
    await timers.pass(5000);
    assert.equal(asked, 1);
  }
});

test('a watch that breaks is opened again; a lease that is lost ends it', async () => {
  const errors = [refusal(Code.Unavailable), refusal(Code.FailedPrecondition, 'LEASE_SUPERSEDED')];
  const tokens: bigint[] = [];
  const client = clientOf(({ service }) => service(RobotService, {
    async* watchRobot({ leaseToken }) {
      tokens.push(leaseToken);
      yield { notice: { case: 'standing' as const, value: { paused: tokens.length === 2 } } };
      throw errors[tokens.length - 1]!;
    },
  }));
  const paused: boolean[] = [];
  const watching = (async () => {
    for await (const notice of watchRobot(client, 'missions/hall/robots/scout', { leaseToken: 7n })) {
      if (notice.case === 'standing') paused.push(notice.value.paused);
    }
  })();
  watching.catch(() => {}); // awaited below
  await timers.pass(130);
  await assert.rejects(watching, /LEASE_SUPERSEDED/);
  assert.deepEqual(paused, [false, true]);
  assert.deepEqual(tokens, [7n, 7n]);
});
