# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What a robot has observed, numbered, until the server has it on its disk."""

from __future__ import annotations

import bisect
import dataclasses
import threading

from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import system_service_pb2 as system_pb

MAX_KEPT_BYTES = 256 << 20
_ROOM_FOR_OBSERVATIONS = 0.75  # of a request; the rest is for what goes around them
_DROPPED_SHARE = 0.1  # of a full log at a time


@dataclasses.dataclass(frozen=True)
class Rejection:
    """An observation that the server refused; it counts as applied."""

    sequence: int
    message: str


class Log:
    """Thread-safe. A server that calls nothing durable keeps nothing on a disk: what it has applied
    is kept too, for it may restart."""

    def __init__(self, applied_sequence: int, max_kept_bytes: int = MAX_KEPT_BYTES) -> None:
        """applied_sequence: what the server has of logs before this one, which goes on from
        there."""
        self._lock = threading.Lock()
        self._max_kept_bytes = max_kept_bytes
        self._kept: list[ingest_pb.Observation] = []  # in order of number
        self._kept_bytes = 0
        self.last_sequence = applied_sequence
        self.applied_sequence = applied_sequence
        self.durable_sequence = 0
        self.lost_count = 0  # dropped from a full log before any server had applied them

    def add(self, observation: ingest_pb.Observation) -> int:
        """Numbers an observation; returns its number."""
        with self._lock:
            self.last_sequence += 1
            observation.sequence = self.last_sequence
            self._kept.append(observation)
            self._kept_bytes += observation.ByteSize()
            if self._kept_bytes > self._max_kept_bytes:
                self._drop(max(1, int(len(self._kept) * _DROPPED_SHARE)))
                self._declare_gap()
            return self.last_sequence

    @property
    def kept_count(self) -> int:
        return len(self._kept)

    def batch(
        self, limits: system_pb.ServerLimits, after: int, credit: int | None = None
    ) -> ingest_pb.ObservationBatch:
        """The next observations after this number, up to a credit; at most what a request takes."""
        batch, size = ingest_pb.ObservationBatch(), 0
        with self._lock:
            first = self._index_after(after)
            for observation in self._kept[first : first + limits.max_batch_observation_count]:
                size += observation.ByteSize()
                is_full = size > limits.max_receive_bytes * _ROOM_FOR_OBSERVATIONS
                if batch.observations and is_full:
                    break
                if credit is not None and last_sequence_of(observation) > credit:
                    break
                batch.observations.append(observation)
                if observation.sequence <= after:  # the rest of a gap
                    batch.observations[-1].sequence = after + 1
                    batch.observations[-1].gap.first_sequence = after + 1
        return batch

    def is_longer_than(self, count: int) -> bool:
        """Whether more entries than these wait."""
        with self._lock:
            return len(self._kept) - self._index_after(self.applied_sequence) > count

    def note(self, state: ingest_pb.IngestState) -> None:
        """Takes what the server has acknowledged, and forgets what is on its disk."""
        with self._lock:
            self.applied_sequence = max(self.applied_sequence, state.applied_sequence)
            self.durable_sequence = max(self.durable_sequence, state.durable_sequence)
            self._drop(self._index_after(self.durable_sequence))

    def go_back(self, applied_sequence: int) -> None:
        """The server has only this much: what is still kept is told again, the rest is a gap."""
        with self._lock:
            self.applied_sequence = applied_sequence
            self.durable_sequence = min(self.durable_sequence, applied_sequence)
            self._declare_gap()

    def renumber(self, applied_sequence: int) -> None:
        """Another log has been written meanwhile: what the server has not of this one follows
        it."""
        with self._lock:
            self._drop(self._index_after(self.applied_sequence))
            shift = applied_sequence - self.applied_sequence
            for observation in self._kept:
                observation.sequence += shift
                if observation.HasField("gap"):
                    observation.gap.first_sequence += shift
                    observation.gap.last_sequence += shift
            self.last_sequence += shift
            self.applied_sequence = applied_sequence
            self.durable_sequence = 0

    def _index_after(self, sequence: int) -> int:
        return bisect.bisect_right(self._kept, sequence, key=last_sequence_of)

    def _drop(self, count: int) -> None:
        for observation in self._kept[:count]:
            self._kept_bytes -= observation.ByteSize()
            if observation.sequence > self.applied_sequence and not observation.HasField("gap"):
                self.lost_count += 1
        del self._kept[:count]

    def _declare_gap(self) -> None:
        """Numbers that are gone before the server has them stand in the log as a gap."""
        waiting = self._index_after(self.applied_sequence)
        first_kept = (
            self._kept[waiting].sequence if waiting < len(self._kept) else self.last_sequence + 1
        )
        if first_kept > self.applied_sequence + 1:
            gap = ingest_pb.SequenceGap(
                first_sequence=self.applied_sequence + 1, last_sequence=first_kept - 1
            )
            observation = ingest_pb.Observation(sequence=gap.first_sequence, gap=gap)
            self._kept.insert(waiting, observation)
            self._kept_bytes += observation.ByteSize()


def last_sequence_of(observation: ingest_pb.Observation) -> int:
    """The last number that an entry of the log stands for."""
    if observation.HasField("gap"):
        return observation.gap.last_sequence
    return observation.sequence
