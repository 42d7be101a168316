// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { create } from '@bufbuild/protobuf';
import { GetServerInfoResponseSchema } from '@plumescout/client/wire';

// The session, of a page; imported once that is there.
async function sessionOfPage() {
  Object.assign(globalThis, { location: { origin: 'http://localhost' }, sessionStorage: { getItem: () => null } });
  return import('../src/session.ts');
}

test('operators and admins are offered what changes missions, others are not', async () => {
  const { mayOperate, session } = await sessionOfPage();
  assert.ok(mayOperate()); // the server has not told yet, and decides anyway
  const may = (callerRole: string) => {
    session.info = create(GetServerInfoResponseSchema, { callerRole });
    return mayOperate();
  };
  assert.deepEqual(['operator', 'admin', 'viewer', 'robot', ''].map(may), [true, true, false, false, false]);
});
