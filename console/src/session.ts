// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What the page knows of the server and of who looks on.
import { PATIENCE, system } from './client.ts';
import type { GetServerInfoResponse } from '@plumescout/client/wire';

export const session: { info: GetServerInfoResponse | null } = { info: null };

export async function refreshSession(): Promise<GetServerInfoResponse> {
  session.info = await system.getServerInfo({}, PATIENCE);
  return session.info;
}

// Whether the caller may change missions. The server decides; this is what is offered.
export function mayOperate(): boolean {
  return session.info === null || ['operator', 'admin'].includes(session.info.callerRole);
}
