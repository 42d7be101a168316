// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// How long after its beginning a mission was at a revision, by its own time: between the refreshes of
// the gas posterior before and after, which are about a second apart.
import { MissionEventKind } from '@plumescout/client/wire';
import type { MissionEvent } from '@plumescout/client/wire';

// Events with the mission's time; observations have those of the robots' clocks.
const TIMED = [MissionEventKind.REFRESH, MissionEventKind.EPOCH_BEGUN];
// The last such event before a revision is looked for among so many, then among so many times more.
const FIRST_LOOK_BACK = 64n;
const WIDER = 16n;
const MOST_ON_A_PAGE = 1000n;
const S_PER_NS = 1e-9;

type Timed = { number: bigint; time_ns: bigint };

const timedOf = (events: HistoryPage['events']): Timed[] => events.flatMap(({ number, sampleTimeNs }) =>
  (sampleTimeNs === undefined ? [] : [{ number, time_ns: sampleTimeNs }]));
export type HistoryPage = { events: Pick<MissionEvent, 'number' | 'sampleTimeNs'>[]; nextPageToken: string };
export type HistoryRequest = { kinds: MissionEventKind[]; firstNumber: bigint; pageSize: number; pageToken: string };

export class MissionClock {
  private first: Timed | null = null;
  private tail: Timed | null = null; // that none followed when somebody looked
  private busy = false;
  private next: (() => Promise<void>) | null = null;

  constructor(private readonly history: (request: HistoryRequest) => Promise<HistoryPage>) {}

  // Null: it is not known. Errors are those of the call.
  async elapsed_s(revision: bigint): Promise<number | null> {
    this.first ??= await this.firstFrom(0n);
    if (this.first === null) return null;
    if (revision <= this.first.number) return 0;
    const before = await this.lastBefore(revision) ?? this.first;
    const after = await this.firstFrom(revision);
    const since_s = (at: Timed) => Number(at.time_ns - this.first!.time_ns) * S_PER_NS;
    if (after === null) {
      this.tail = before;
      return since_s(before);
    }
    const share = Number(revision - before.number) / Number(after.number - before.number);
    return since_s(before) + share * (since_s(after) - since_s(before));
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

  // The first event at or after the revision.
  private async firstFrom(revision: bigint): Promise<Timed | null> {
    let pageToken = '';
    do {
      const { events, nextPageToken } = await this.history({ kinds: TIMED, firstNumber: revision, pageSize: 1, pageToken });
      const found = timedOf(events);
      if (found.length > 0) return found[0];
      pageToken = nextPageToken;
    } while (pageToken !== '');
    return null;
  }
  // The last event before the revision; null: there is none.
  private async lastBefore(revision: bigint): Promise<Timed | null> {
    const least = this.tail !== null && this.tail.number < revision ? this.tail.number : 0n;
    for (let span = FIRST_LOOK_BACK; ; span *= WIDER) {
      const from = revision - span > least ? revision - span : least;
      const last = await this.lastAmong(from, revision, Number(span < MOST_ON_A_PAGE ? span : MOST_ON_A_PAGE));
      if (last !== null || from === least) return last;
    }
  }
  private async lastAmong(from: bigint, revision: bigint, pageSize: number): Promise<Timed | null> {
    let last: Timed | null = null;
    let pageToken = '';
    do {
      const { events, nextPageToken } = await this.history({ kinds: TIMED, firstNumber: from, pageSize, pageToken });
      const found = timedOf(events);
      last = found.filter(({ number }) => number < revision).at(-1) ?? last;
      if (found.some(({ number }) => number >= revision)) break;
      pageToken = nextPageToken;
    } while (pageToken !== '');
    return last;
  }
}
