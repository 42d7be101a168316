// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Code } from '@connectrpc/connect';
import type { MessageInitShape } from '@bufbuild/protobuf';
import { RobotSession } from '../src/robot_session.ts';
import type { RegisterOptions } from '../src/robot_session.ts';
import { IngestService, PlanningService, RobotService, SystemService } from '../src/wire/index.ts';
import type {
  NextBestTrajectoryRequest, RegisterRobotRequest, RegisterRobotResponseSchema, StreamObservationsResponseSchema,
} from '../src/wire/index.ts';
import { Timers, clientOf, refusal, settle } from './support.ts';

type Answer = MessageInitShape<typeof StreamObservationsResponseSchema>;
// What a stream does with a batch of these numbers: answers, or ends by throwing.
type OnBatch = (numbers: (number | number[])[]) => Answer[];

const timers = new Timers();
const opened = (applied: number, credit: number): Answer =>
  ({ frame: { case: 'opened', value: { ingestState: state(applied, credit) } } });
const ack = (applied: number, credit: number, durable = 0): Answer =>
  ({ frame: { case: 'ack', value: state(applied, credit, durable) } });
const state = (applied: number, credit: number, durable = 0) => ({
  appliedSequence: BigInt(applied), creditSequence: BigInt(credit), durableSequence: BigInt(durable) });

// A session with a server whose n-th stream is opened with the n-th answer, or refused with the error.
async function joined(streams: { first: Answer | Error; onBatch?: OnBatch }[], options: Partial<RegisterOptions> = {},
                      maxReceiveBytes = 1 << 18) {
  const opens: bigint[] = [];
  const batches: (number | number[])[][] = [];
  const plans: NextBestTrajectoryRequest[] = [];
  const leases: bigint[] = [];
  const registrations: RegisterRobotRequest[] = [];
  // What a restarted server answers; without, there is none.
  const later: { registered?: MessageInitShape<typeof RegisterRobotResponseSchema> | Error } = {};
  const client = clientOf(({ service }) => {
    service(RobotService, { registerRobot: (request) => {
      registrations.push(request);
      if (registrations.length > 1 && later.registered instanceof Error) throw later.registered;
      return {
        robot: 'missions/hall/robots/scout', leaseToken: 7n, ingestState: state(0, 0), serverBootId: 'first',
        ...(registrations.length > 1 ? later.registered as object : {}) };
    } });
    service(SystemService, { getServerInfo: () => ({
      limits: { maxReceiveBytes },
      bootId: later.registered === undefined ? 'first' : 'second' }) });
    service(PlanningService, { nextBestTrajectory: (request) => {
      plans.push(request);
      return { plan: { name: 'missions/hall/plans/1' } };
    } });
    service(IngestService, { async* streamObservations(requests) {
      const { first, onBatch = () => [] } = streams[opens.length]!;
      for await (const { frame } of requests) {
        if (frame.case === 'open') {
          opens.push(frame.value.durableSequence);
          leases.push(frame.value.leaseToken);
          if (first instanceof Error) throw first;
          yield first;
        } else if (frame.case === 'batch') {
          const numbers = frame.value.observations.map((one) => (one.payload.case === 'gap'
            ? [Number(one.sequence), Number(one.payload.value.lastSequence)] : Number(one.sequence)));
          batches.push(numbers);
          yield* onBatch(numbers);
        }
      }
    } });
  });
  const session = await RobotSession.register(client, {
    mission: 'missions/hall', robotId: 'scout', radius_m: 0.2, clock_ns: null, onRejected: () => {}, ...options });
  return { session, opens, batches, plans, leases, registrations, later };
}

function addReadings(session: RobotSession, count: number): void {
  const pose = { x_m: 0, y_m: 0, yaw_rad: 0 };
  for (let i = 0; i < count; ++i) session.addGas({ time_ns: 1n, pose, concentration_ppm: 1 });
}

test('observations are sent as far as there is credit', async () => {
  const { session, batches } = await joined([{ first: opened(0, 2), onBatch: (numbers) =>
    (numbers.includes(2) ? [ack(2, 3)] : [ack(3, 4)]) }]);
  addReadings(session, 3);
  await session.applied();
  assert.deepEqual(batches, [[1, 2], [3]]);
  assert.deepEqual(session.statistics, { lastSequence: 3, applied: 3, durable: 0, rejected: 0, lost: 0, reconnects: 0 });
  session.close();
});

test('a batch is no larger than what the server takes', async () => {
  const { session, batches } = await joined([{ first: opened(0, 9), onBatch: (numbers) =>
    [ack(numbers.at(-1) as number, 9)] }], {}, 16);
  addReadings(session, 3); // of some 20 bytes each
  await session.applied();
  assert.deepEqual(batches, [[1], [2], [3]]);
  session.close();
});

test('a stream that breaks is opened again, and goes on where the server says', async () => {
  const links: boolean[] = [];
  const { session, batches, opens } = await joined([
    { first: opened(0, 9), onBatch: () => { throw refusal(Code.Unavailable); } },
    { first: opened(2, 9), onBatch: () => [ack(3, 9, 3)] }], { onLink: (up) => { links.push(up); } });
  await settle();
  addReadings(session, 3);
  await timers.pass(130); // a tenth of a second, spread by a fifth
  await session.durable();
  assert.deepEqual(batches.at(-1), [3]);
  assert.equal(opens.length, 2);
  assert.deepEqual(links, [true, false, true]);
  assert.equal(session.statistics.reconnects, 1);
  session.close();
});

test('what a full log has lost is declared', async () => {
  const { session, batches } = await joined([{ first: opened(0, 9), onBatch: () => [ack(5, 9)] }],
                                            { log: { maxObservations: 2 } });
  addReadings(session, 5); // before the stream is open
  await session.applied();
  assert.deepEqual(batches, [[[1, 3], 4, 5]]);
  assert.equal(session.statistics.lost, 3);
  session.close();
});

test('refused observations are told, and count as applied', async () => {
  const refused: [number, string][] = [];
  const { session } = await joined([{ first: opened(0, 9), onBatch: () => [
    { frame: { case: 'rejected', value: { sequence: 1n, status: { message: 'beyond the map' } } } }, ack(1, 9)] }],
    { onRejected: ({ sequence, message }) => { refused.push([sequence, message]); } });
  addReadings(session, 1);
  await session.applied();
  assert.deepEqual(refused, [[1, 'beyond the map']]);
  assert.equal(session.statistics.rejected, 1);
  session.close();
});

test('a lease that another has taken ends the session', async () => {
  const { session, opens } = await joined([{ first: refusal(Code.FailedPrecondition, 'LEASE_SUPERSEDED') }]);
  addReadings(session, 1);
  await assert.rejects(session.applied(), /LEASE_SUPERSEDED/);
  await assert.rejects(session.nextBestTrajectory(), /LEASE_SUPERSEDED/);
  await timers.pass(5000);
  assert.equal(opens.length, 1);
});

test('a robot that a restarted server has lost registers again, and tells all it still has', async () => {
  const { session, later, leases, opens, batches, registrations } = await joined([
    { first: opened(0, 9), onBatch: (numbers) => {
      if (numbers.includes(3)) throw refusal(Code.Unavailable);
      return [ack(2, 9)];
    } },
    { first: refusal(Code.NotFound, 'ROBOT_NOT_FOUND') },
    { first: opened(0, 9), onBatch: () => [ack(3, 9)] }], { takeOver: true });
  addReadings(session, 2);
  await session.applied();
  later.registered = { leaseToken: 8n, ingestState: state(0, 0), serverBootId: 'second' };
  addReadings(session, 1);
  await timers.pass(130);
  await timers.pass(200);
  await session.applied();
  assert.deepEqual(leases, [7n, 7n, 8n]);
  assert.deepEqual(opens, [0n, 0n, 0n]);
  assert.deepEqual(batches.at(-1), [1, 2, 3]);
  assert.equal(session.leaseToken, 8n);
  assert.deepEqual(registrations.map(({ takeOver }) => takeOver), [true, false]);
  assert.equal(registrations[0]!.logEpoch, registrations[1]!.logEpoch);
  session.close();
});

test('a robot that was removed stays away', async () => {
  const { session, registrations } = await joined([{ first: refusal(Code.NotFound, 'ROBOT_NOT_FOUND') }]);
  addReadings(session, 1);
  await assert.rejects(session.applied(), /ROBOT_NOT_FOUND/);
  assert.equal(registrations.length, 1);
});

test('a robot whose lease another client has since ends', async () => {
  const { session, later } = await joined([
    { first: opened(0, 9), onBatch: () => { throw refusal(Code.Unavailable); } },
    { first: refusal(Code.NotFound, 'ROBOT_NOT_FOUND') }]);
  later.registered = refusal(Code.FailedPrecondition, 'LEASE_HELD');
  addReadings(session, 1);
  const held = assert.rejects(session.applied(), /LEASE_HELD/);
  await timers.pass(130);
  await held;
});

test('what a callback throws ends the session, and is no matter of the link', async () => {
  for (const options of [
    { onRejected: () => { throw new Error('mine'); } },
    { onLink: (up: boolean) => { if (up) throw new Error('mine'); } },
    { onLink: () => { throw new Error('mine'); } }]) {
    const { session, opens } = await joined([{ first: opened(0, 9), onBatch: () => [
      { frame: { case: 'rejected', value: { sequence: 1n, status: { message: 'beyond the map' } } } }] }], options);
    addReadings(session, 1);
    await assert.rejects(session.applied(), /mine/);
    await timers.pass(5000);
    assert.equal(opens.length, 1);
  }
});

test('a server with more observations than were made has those of another log', async () => {
  const { session } = await joined([{ first: opened(4, 9) }]);
  addReadings(session, 1);
  await assert.rejects(session.applied(), /holds 4 observations of this robot, its own log only 1/);
});

test('a server that was set back is told what it had called durable before', async () => {
  const { session, opens, batches } = await joined([
    { first: opened(0, 9), onBatch: (numbers) => {
      if (numbers.includes(4)) throw refusal(Code.Unavailable);
      return [ack(3, 9, 2)];
    } },
    { first: refusal(Code.FailedPrecondition, 'STORE_ROLLED_BACK', { applied_sequence: '1' }) },
    { first: opened(1, 9), onBatch: () => [ack(4, 9, 3)] }]);
  addReadings(session, 3);
  await session.applied();
  addReadings(session, 1);
  await timers.pass(130);
  await timers.pass(200);
  assert.deepEqual(opens, [0n, 2n, 1n]);
  assert.deepEqual(batches.at(-1), [[2, 2], 3, 4]); // 2 was durable, and is gone here
  session.close();
});

test('plans know what was observed', async () => {
  const { session, plans } = await joined([{ first: opened(0, 9), onBatch: () => [ack(2, 9)] }]);
  addReadings(session, 2);
  const plan = await session.nextBestTrajectory({ budget_s: 0.5, seed: 3n, start: { x_m: 1, y_m: 2, yaw_rad: 0 } });
  assert.equal(plan.name, 'missions/hall/plans/1');
  const [request] = plans;
  assert.equal(request!.minAppliedSequence, 2n);
  assert.equal(request!.leaseToken, 7n);
  assert.equal(request!.planningBudget?.nanos, 500_000_000);
  assert.equal(request!.start?.xM, 1);
  session.close();
});

test('what does not come in time is said', async () => {
  const { session } = await joined([{ first: opened(0, 0) }]);
  addReadings(session, 1);
  const late = assert.rejects(session.applied(3), /applied observation 0 of 1 after 3 s/);
  await timers.pass(3000);
  await late;
  session.close();
  await assert.rejects(session.applied(3), /closed/);
});
