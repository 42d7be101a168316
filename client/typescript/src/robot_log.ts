// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import { create } from '@bufbuild/protobuf';
import { ObservationSchema } from './wire/index.ts';
import type { Observation } from './wire/index.ts';

export type LogOptions = {
  maxObservations: number; // 200,000: 4.6 h of 10 Hz scans and 2 Hz gas
  maxBytes: number; // 256 MiB
};

export const DEFAULT_LOG: LogOptions = { maxObservations: 200_000, maxBytes: 1 << 28 };

const OVERHEAD_BYTES = 512; // of an observation in memory, about

function sizeOf({ payload }: Observation): number {
  if (payload.case === 'scan') return OVERHEAD_BYTES + payload.value.rangesU16.length;
  if (payload.case === 'correction') return OVERHEAD_BYTES * (1 + payload.value.anchors.length);
  return OVERHEAD_BYTES;
}

// A robot's numbered observations until the server holds them on its disk: all between the first that
// is held and the last. When it is full the oldest go, and numbers that went are told as a gap.
export class RobotLog {
  lost = 0; // went before any server had applied them
  private applied: number;
  private entries: Observation[] = [];
  private begin = 0; // of the entries that are held
  private bytes = 0;
  private firstHeld: number;
  private latest = create(ObservationSchema);

  // The first observation gets the number after this one.
  constructor(lastSequence: number, private readonly options: LogOptions = DEFAULT_LOG) {
    this.firstHeld = lastSequence + 1;
    this.applied = lastSequence;
  }
  get firstSequence(): number {
    return this.firstHeld;
  }
  get lastSequence(): number {
    return this.firstHeld + this.entries.length - this.begin - 1;
  }

  // Numbers it. Returns the number.
  append(observation: Observation): number {
    const sequence = this.lastSequence + 1;
    observation.sequence = BigInt(sequence);
    this.entries.push(observation);
    this.latest = observation;
    this.bytes += sizeOf(observation);
    const { maxObservations, maxBytes } = this.options;
    while (this.firstHeld < sequence && (sequence - this.firstHeld >= maxObservations || this.bytes > maxBytes)) {
      if (this.firstHeld > this.applied) ++this.lost;
      this.dropOldest();
    }
    return sequence;
  }

  // What the server says. A server that keeps nothing on disk calls nothing durable.
  acknowledge(applied: number, durable: number): void {
    this.applied = applied;
    while (this.firstHeld <= Math.min(durable, this.lastSequence)) this.dropOldest();
  }

  // Observations from a number on, at most through another: one at least, however long it is. What
  // went is told first, as a gap.
  read(fromSequence: number, throughSequence: number, maxObservations: number,
       maxBytes: number): Observation[] {
    const batch: Observation[] = [];
    if (fromSequence > Math.min(throughSequence, this.lastSequence)) return batch;
    if (fromSequence < this.firstHeld) batch.push(this.gapFrom(fromSequence));
    const last = Math.min(throughSequence, this.lastSequence);
    let bytes = 0;
    for (let sequence = Math.max(fromSequence, this.firstHeld); sequence <= last; ++sequence) {
      const observation = this.entries[this.begin + sequence - this.firstHeld]!;
      bytes += sizeOf(observation);
      if (batch.length > 0 && (batch.length >= maxObservations || bytes > maxBytes)) break;
      batch.push(observation);
    }
    return batch;
  }

  private gapFrom(firstSequence: number): Observation {
    const beside = this.entries[this.begin] ?? this.latest;
    const range = { firstSequence: BigInt(firstSequence), lastSequence: BigInt(this.firstHeld - 1) };
    return create(ObservationSchema, {
      sequence: range.firstSequence, sampleTimeNs: beside.sampleTimeNs,
      ...(beside.pose === undefined ? {} : { pose: beside.pose }),
      payload: { case: 'gap', value: range },
    });
  }

  private dropOldest(): void {
    this.bytes -= sizeOf(this.entries[this.begin]!);
    ++this.firstHeld;
    ++this.begin;
    if (2 * this.begin < this.entries.length) return;
    this.entries = this.entries.slice(this.begin); // O(1) an entry, as half of them went
    this.begin = 0;
  }
}

export function lastSequenceOf({ sequence, payload }: Observation): number {
  return Number(payload.case === 'gap' ? payload.value.lastSequence : sequence);
}
