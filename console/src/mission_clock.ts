// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// How long after its beginning a mission was at a revision, by its own time: to the refresh of the gas
// posterior that came next, about a second.
import { MissionEventKind } from '@plumescout/client/wire';
import type { MissionEvent } from '@plumescout/client/wire';

// Events with the mission's time; observations have those of the robots' clocks.
const TIMED = [MissionEventKind.REFRESH, MissionEventKind.EPOCH_BEGUN];
// The last such event before a revision that none follows is looked for among so many.
const LOOK_BACK = 500n;
const MOST_PAGES = 4;
const S_PER_NS = 1e-9;

export type HistoryPage = { events: Pick<MissionEvent, 'number' | 'sampleTimeNs'>[]; nextPageToken: string };
export type HistoryRequest = { kinds: MissionEventKind[]; firstNumber: bigint; pageSize: number; pageToken: string };

export class MissionClock {
  private begin_ns: bigint | null = null;
  private busy = false;
  private next: (() => Promise<void>) | null = null;

  constructor(private readonly history: (request: HistoryRequest) => Promise<HistoryPage>) {}

  // Null: it is not known. Errors are those of the call.
  async elapsed_s(revision: bigint): Promise<number | null> {
    this.begin_ns ??= await this.firstAfter(0n);
    if (this.begin_ns === null) return null;
    const at_ns = await this.firstAfter(revision) ?? await this.lastBefore(revision);
    return at_ns === null ? null : Number(at_ns - this.begin_ns) * S_PER_NS;
  }

  // One question at a time: of those that come meanwhile the last is asked. Null: it is not known, or not told.
  tell(revision: bigint, told: (elapsed_s: number | null) => void): void {
    this.next = async () => told(await this.elapsed_s(revision).catch(() => null));
    if (!this.busy) void this.work();
  }
  private async work(): Promise<void> {
    this.busy = true;
    while (this.next !== null) {
      const task = this.next;
      this.next = null;
      await task();
    }
    this.busy = false;
  }

  private async firstAfter(revision: bigint): Promise<bigint | null> {
    let pageToken = '';
    for (let page = 0; page < MOST_PAGES; ++page) {
      const { events, nextPageToken } = await this.history({ kinds: TIMED, firstNumber: revision, pageSize: 1, pageToken });
      if (events[0]?.sampleTimeNs !== undefined) return events[0].sampleTimeNs;
      if (nextPageToken === '') return null;
      pageToken = nextPageToken;
    }
    return null;
  }
  private async lastBefore(revision: bigint): Promise<bigint | null> {
    const firstNumber = revision > LOOK_BACK ? revision - LOOK_BACK : 0n;
    const { events } = await this.history({ kinds: TIMED, firstNumber, pageSize: Number(LOOK_BACK), pageToken: '' });
    return events.at(-1)?.sampleTimeNs ?? null;
  }
}
