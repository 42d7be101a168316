// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { DEFAULT_LOG, RobotLog, lastSequenceOf } from '../src/robot_log.ts';
import { ObservationSchema } from '../src/wire/index.ts';

const reading = (time: number) => create(ObservationSchema, {
  sampleTimeNs: BigInt(time), pose: { xM: time }, payload: { case: 'gas', value: { concentrationPpm: time } } });

// Numbers of what is read; a gap as [first, last].
function numbers(log: RobotLog, from: number, through = 1000, count = 1000, bytes = 1e9) {
  return log.read(from, through, count, bytes).map((one) =>
    (one.payload.case === 'gap' ? [Number(one.sequence), lastSequenceOf(one)] : Number(one.sequence)));
}

function logOf(count: number, options = {}) {
  const log = new RobotLog(10, { ...DEFAULT_LOG, ...options });
  for (let i = 1; i <= count; ++i) assert.equal(log.append(reading(i)), 10 + i);
  return log;
}

test('observations are numbered after what the server has, and read within limits', () => {
  const log = logOf(4);
  assert.equal(log.lastSequence, 14);
  assert.deepEqual(numbers(log, 11), [11, 12, 13, 14]);
  assert.deepEqual(numbers(log, 12, 13), [12, 13]);
  assert.deepEqual(numbers(log, 11, 1000, 2), [11, 12]);
  assert.deepEqual(numbers(log, 11, 1000, 2, 1), [11]); // one at least
  assert.deepEqual(numbers(log, 15), []);
  assert.deepEqual(numbers(log, 11, 10), []);
});

test('what is durable goes, and is a gap if it is asked for again', () => {
  const log = logOf(4);
  log.acknowledge(13, 12);
  assert.equal(log.firstSequence, 13);
  assert.equal(log.lost, 0);
  assert.deepEqual(numbers(log, 11), [[11, 12], 13, 14]);
  const [gap] = log.read(12, 1000, 1, 1);
  assert.deepEqual([gap!.sequence, gap!.sampleTimeNs, gap!.pose?.xM], [12n, 3n, 3]); // beside the next
  log.acknowledge(14, 14);
  assert.equal(log.lastSequence, 14);
  assert.deepEqual(numbers(log, 11), [[11, 14]]);
  assert.equal(log.append(reading(5)), 15);
});

test('a full log drops the oldest, and counts what no server has', () => {
  const log = logOf(3, { maxObservations: 3 });
  log.acknowledge(11, 0);
  for (let i = 4; i <= 6; ++i) log.append(reading(i));
  assert.equal(log.firstSequence, 14);
  assert.equal(log.lost, 2); // 12 and 13
  assert.deepEqual(numbers(log, 12), [[12, 13], 14, 15, 16]);
  assert.deepEqual(numbers(logOf(9, { maxBytes: 1 }), 11), [[11, 18], 19]); // the newest is kept
});
