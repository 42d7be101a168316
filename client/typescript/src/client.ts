// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import { createClient } from '@connectrpc/connect';
import type { Client as ServiceClient, Transport } from '@connectrpc/connect';
import {
  IngestService, MapService, MissionService, PlanningService, RobotService, SnapshotService, SystemService,
} from './wire/index.ts';

/** All calls of a server, by service; each takes and returns the messages of
 * '@plumescout/client/wire'. Made by connect(). */
export class Client {
  readonly missions: ServiceClient<typeof MissionService>;
  readonly robots: ServiceClient<typeof RobotService>;
  readonly ingest: ServiceClient<typeof IngestService>;
  readonly maps: ServiceClient<typeof MapService>;
  readonly planning: ServiceClient<typeof PlanningService>;
  readonly snapshots: ServiceClient<typeof SnapshotService>;
  readonly system: ServiceClient<typeof SystemService>;

  /** Calls fail once it is closed. */
  constructor(transport: Transport, readonly close: () => void = () => {}) {
    this.missions = createClient(MissionService, transport);
    this.robots = createClient(RobotService, transport);
    this.ingest = createClient(IngestService, transport);
    this.maps = createClient(MapService, transport);
    this.planning = createClient(PlanningService, transport);
    this.snapshots = createClient(SnapshotService, transport);
    this.system = createClient(SystemService, transport);
  }
}

const USUAL_REQUEST_BYTES = 1 << 18;

/** Bytes that the server takes in one request. Of one that does not say, what servers take unless they
 * are told otherwise: if it cannot be asked, the next call says why. */
export async function maxRequestBytes(client: Client, signal?: AbortSignal): Promise<number> {
  try {
    const { limits } = await client.system.getServerInfo({}, signal === undefined ? {} : { signal });
    return limits?.maxReceiveBytes || USUAL_REQUEST_BYTES;
  } catch {
    return USUAL_REQUEST_BYTES;
  }
}

/** The items of a list that comes in pages:
 *   await all((pageToken) => client.missions.listMissions({ pageToken }), (page) => page.missions) */
export async function all<Page extends { nextPageToken: string }, Item>(
  ask: (pageToken: string) => Promise<Page>, itemsOf: (page: Page) => Item[]): Promise<Item[]> {
  const items: Item[] = [];
  let pageToken = '';
  do {
    const page = await ask(pageToken);
    items.push(...itemsOf(page));
    pageToken = page.nextPageToken;
  } while (pageToken !== '');
  return items;
}
