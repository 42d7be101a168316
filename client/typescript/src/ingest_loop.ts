// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Brings a robot's log to the server and keeps it there, whatever the link does.
import type { MessageInitShape } from '@bufbuild/protobuf';
import { OwnAbort } from './abort.ts';
import { Backoff, pause } from './backoff.ts';
import { LINK_BACKOFF } from './calls.ts';
import { maxRequestBytes } from './client.ts';
import type { Client } from './client.ts';
import { Code, errorOf, isFinal } from './errors.ts';
import type { CallError } from './errors.ts';
import { lastSequenceOf } from './robot_log.ts';
import type { RobotLog } from './robot_log.ts';
import type { IngestState, ObservationRejected, StreamObservationsRequestSchema } from './wire/index.ts';

const MAX_BATCH_OBSERVATIONS = 64;
const ROOM_FOR_OBSERVATIONS = 0.75; // of a request; the rest is for what goes around them

// That the server has lost the robot, or its mission.
const LOST = ['MISSION_NOT_FOUND', 'ROBOT_NOT_FOUND'];
const PASSING = [Code.Unavailable, Code.ResourceExhausted, Code.DeadlineExceeded];
const ENDING = ['LEASE_SUPERSEDED', 'MISSION_FINISHED'];

// How the robot stands with the server once it has registered.
export type Standing = { leaseToken: bigint; applied: number };

export type IngestOptions = {
  robot: string; // missions/{mission}/robots/{robot}
  leaseToken: bigint;
  // Registers again with a server that has restarted and lost the robot; null: it has not restarted,
  // somebody removed the robot.
  rejoin: () => Promise<Standing | null>;
  clock_ns: (() => bigint) | null; // the robot's, now; null: it is taken as it is
  onRejected: (rejected: ObservationRejected) => void;
  onLink: (up: boolean, error: CallError | null) => void;
};

// Wakes all who wait.
class Bell {
  private rung!: Promise<void>;
  private resolve!: () => void;
  constructor() {
    this.ring();
  }
  ring(): void {
    const resolve = this.resolve as (() => void) | undefined;
    this.rung = new Promise((done) => { this.resolve = done; });
    resolve?.();
  }
  heard(): Promise<void> {
    return this.rung;
  }
}

// One stream at a time, opened again with growing waits; it goes on where the server says. Adding to
// the log never waits: call noteAdded.
export class IngestLoop {
  applied: number;
  durable = 0; // 0 of a server that keeps nothing on disk
  reconnects = 0;
  failure: unknown = null; // why it ended for good
  leaseToken: bigint;
  private next: number; // to send, on the present stream
  private credit = 0;
  private keeps = 0; // durable as any server told
  private maxBatchBytes = 0; // of what the present server takes
  private readonly bell = new Bell();
  private readonly abort = new OwnAbort();
  private readonly backoff = new Backoff(LINK_BACKOFF);

  constructor(private readonly client: Client, private readonly log: RobotLog,
              private readonly options: IngestOptions) {
    this.applied = log.lastSequence;
    this.leaseToken = options.leaseToken;
    this.next = this.applied + 1;
    void this.run();
  }

  noteAdded(): void {
    this.bell.ring();
  }
  close(): void {
    this.abort.end();
    this.bell.ring();
  }

  // Until it holds, or `signal` says so. Throws why the loop ended, if it did.
  async until(holds: () => boolean, signal: AbortSignal): Promise<boolean> {
    const wake = () => this.bell.ring();
    signal.addEventListener('abort', wake);
    try {
      while (!holds()) {
        if (this.failure !== null) throw this.failure;
        if (this.abort.signal.aborted) throw new Error('the session is closed');
        if (signal.aborted) return false;
        await this.bell.heard();
      }
      return true;
    } finally {
      signal.removeEventListener('abort', wake);
    }
  }

  private async run(): Promise<void> {
    const { signal } = this.abort;
    try {
      while (!signal.aborted) {
        const error = await this.serveUntilItBreaks();
        if (signal.aborted) return;
        ++this.reconnects;
        this.noteLink(false, error);
        await pause(Math.max(this.backoff.next_s(), error?.retryAfter_s ?? 0), signal);
      }
    } catch (failed) {
      if (signal.aborted) return;
      this.failure ??= failed;
      this.bell.ring();
      try {
        this.options.onLink(false, errorOf(failed));
      } catch {
        // It has failed already.
      }
    }
  }

  // What broke it; null: the server ended it. Throws what another stream would not mend.
  private async serveUntilItBreaks(): Promise<CallError | null> {
    try {
      await this.serveOneStream();
      return null;
    } catch (failed) {
      const error = errorOf(failed);
      if (this.failure !== null || this.abort.signal.aborted) throw failed;
      if (error.reason === 'STORE_ROLLED_BACK') {
        this.keeps = Number(error.metadata['applied_sequence'] ?? 0);
      } else if (LOST.includes(error.reason) ? !await this.rejoined()
        : isFinal(error) || ENDING.includes(error.reason)) {
        throw failed;
      }
      return error;
    }
  }

  // Whether the robot is of the mission again, or may yet be.
  private async rejoined(): Promise<boolean> {
    try {
      const standing = await this.options.rejoin();
      if (standing === null) return false;
      this.leaseToken = standing.leaseToken;
      this.keeps = Math.min(this.keeps, standing.applied);
    } catch (failed) {
      if (!PASSING.includes(errorOf(failed).code)) throw failed;
    }
    return true;
  }

  private noteLink(up: boolean, error: CallError | null): void {
    this.tell(() => this.options.onLink(up, error));
  }
  // What a callback throws ends the session: it has nothing to do with the link.
  private tell(callback: () => void): void {
    try {
      callback();
    } catch (thrown) {
      this.failure = thrown;
      throw thrown;
    }
  }

  private async serveOneStream(): Promise<void> {
    const stream = new OwnAbort(this.abort.signal);
    this.credit = 0;
    try {
      this.maxBatchBytes = ROOM_FOR_OBSERVATIONS * await maxRequestBytes(this.client, stream.signal);
      const responses = this.client.ingest.streamObservations(this.requests(stream.signal), { signal: stream.signal });
      for await (const { frame } of responses) {
        if (frame.case === 'opened') {
          const state = frame.value.ingestState;
          if (state === undefined) continue;
          this.open(Number(state.appliedSequence));
          this.noteState(state);
          this.noteLink(true, null);
        } else if (frame.case === 'ack') {
          this.backoff.reset();
          this.noteState(frame.value);
        } else if (frame.case === 'rejected') {
          const { value } = frame;
          this.tell(() => this.options.onRejected(value));
        }
      }
    } finally {
      stream.end();
      this.bell.ring();
    }
  }

  private open(applied: number): void {
    if (applied > this.log.lastSequence) {
      this.failure = new Error(`the server holds ${applied} observations of this robot, its own log only ` +
                               `${this.log.lastSequence}`);
      throw this.failure;
    }
    this.applied = applied; // less than before, if the server lost some
    this.next = applied + 1;
  }

  private noteState(state: IngestState): void {
    this.applied = Math.max(this.applied, Number(state.appliedSequence));
    this.durable = Number(state.durableSequence);
    this.keeps = Math.max(this.keeps, this.durable);
    this.credit = Math.max(this.credit, Number(state.creditSequence));
    this.log.acknowledge(this.applied, this.durable);
    this.bell.ring();
  }

  private async* requests(signal: AbortSignal): AsyncGenerator<MessageInitShape<typeof StreamObservationsRequestSchema>> {
    const { leaseToken, options: { robot, clock_ns } } = this;
    yield { frame: { case: 'open', value: { robot, leaseToken, durableSequence: BigInt(this.keeps) } } };
    while (!signal.aborted) {
      const observations = this.log.read(this.next, this.credit, MAX_BATCH_OBSERVATIONS, this.maxBatchBytes);
      if (observations.length === 0) {
        await this.bell.heard();
        continue;
      }
      this.next = lastSequenceOf(observations.at(-1)!) + 1;
      yield { frame: { case: 'batch', value: { observations, sentTimeNs: clock_ns?.() ?? 0n } } };
    }
  }
}
