// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Code, ConnectError } from '@connectrpc/connect';
import { errorOf, isFinal } from '../src/errors.ts';
import { BadRequestSchema, ErrorInfoSchema, RetryInfoSchema } from '../src/wire/index.ts';

test('what a server says of an error is found', () => {
  const error = errorOf(new ConnectError('radius_m = -1 must be > 0', Code.InvalidArgument, undefined, [
    { desc: ErrorInfoSchema, value: { reason: 'LEASE_HELD', metadata: { holder: 'scout' } } },
    { desc: BadRequestSchema, value: { fieldViolations: [{ field: 'radius_m' }, { field: 'frame' }] } },
    { desc: RetryInfoSchema, value: { retryDelay: { seconds: 2n, nanos: 500_000_000 } } },
  ]));
  assert.deepEqual(error, {
    code: Code.InvalidArgument, reason: 'LEASE_HELD', message: 'radius_m = -1 must be > 0',
    fields: ['radius_m', 'frame'], metadata: { holder: 'scout' }, retryAfter_s: 2.5, unanswered: false,
  });
  assert.ok(isFinal(error));
});

test('a link that breaks is Unavailable, however it is told', () => {
  const reset = Object.assign(new Error('read ECONNRESET'), { code: 'ECONNRESET' });
  for (const failed of [
    new ConnectError('fetch failed', Code.Unknown, undefined, undefined, new TypeError('fetch failed')),
    new ConnectError('reset', Code.Aborted, undefined, undefined, reset),
    new ConnectError('http/2 stream closed with error code CANCEL (0x8)', Code.Canceled),
  ]) {
    const error = errorOf(failed);
    assert.equal(error.code, Code.Unavailable);
    assert.ok(error.unanswered);
    assert.ok(!isFinal(error));
  }
});

test('what is no error of a call keeps its words', () => {
  assert.equal(errorOf(new Error('no file')).message, 'no file');
  assert.equal(errorOf('no file').message, 'no file');
  assert.equal(errorOf(new Error('no file')).code, Code.Unknown);
  assert.equal(errorOf(new ConnectError('left', Code.Canceled)).code, Code.Canceled);
});
