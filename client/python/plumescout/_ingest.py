# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""How what a robot observes gets to the server."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import grpc
import numpy as np
import numpy.typing as npt

from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import robot_service_pb2 as robot_pb

from . import rpcs
from ._calls import left_s, pause
from ._log import Log, Rejection, last_sequence_of
from ._operation import Backoff, EndWriting, Open, Operation, Read, Write
from .errors import PlumeScoutError
from .plans import Pose, pose_of

if TYPE_CHECKING:
    from ._client import Operations

_RANGE_UNIT_M = 0.005
_NO_RETURN, _INVALID = 0, 65535  # counts of ranges_u16 with a meaning of their own
_KEPT_REJECTIONS = 10_000
_LOST_REASONS = ("MISSION_NOT_FOUND", "ROBOT_NOT_FOUND")
_LOGGER = logging.getLogger("plumescout")


class Ingest:
    """A robot's standing and its log. add_... may be called on any thread, also while another waits
    for the server; one operation at a time."""

    def __init__(
        self,
        operations: Operations,
        request: robot_pb.RegisterRobotRequest,
        registration: robot_pb.RegisterRobotResponse,
        on_rejected: Callable[[Rejection], None] | None,
        clock_ns: Callable[[], int] | None,
        max_kept_bytes: int,
    ) -> None:
        self._operations = operations
        self._request = request
        self._clock_ns = clock_ns
        self._on_rejected = on_rejected or self._warn
        self._boot_id = registration.server_boot_id
        self._open = ingest_pb.OpenIngest(
            robot=registration.robot, lease_token=registration.lease_token
        )
        # The log is a new one: it begins after whatever the server has of this robot.
        self.log = Log(registration.ingest_state.applied_sequence, max_kept_bytes)
        self.rejections: list[Rejection] = []

    @property
    def name(self) -> str:
        return self._open.robot

    # What the robot observes.

    def add_scan(
        self,
        time_ns: int,
        pose: Pose,
        ranges_m: npt.ArrayLike,
        start_angle_rad: float,
        angle_step_rad: float,
        max_range_m: float,
    ) -> int:
        """Numbers a scan. ranges_m: array; inf: nothing seen, NaN: the beam says nothing.
        Returns its number. Nothing is sent before flush or next_best_trajectory."""
        counts, unit_m = _encode_ranges(np.asarray(ranges_m, dtype=float))
        scan = ingest_pb.LaserScan(
            start_angle_rad=start_angle_rad,
            angle_step_rad=angle_step_rad,
            max_range_m=max_range_m,
            range_unit_m=unit_m,
            ranges_u16=counts.astype("<u2").tobytes(),
        )
        return self._add(ingest_pb.Observation(scan=scan), time_ns, pose)

    def add_gas(
        self,
        time_ns: int,
        pose: Pose,
        concentration_ppm: float,
        stddev_ppm: float = 0.0,
        sensor: int = 0,
    ) -> int:
        """Numbers a gas reading; a deviation of 0 means that of the sensor, or the mission's model.
        sensor: its place among those that the robot registered. Returns its number."""
        reading = ingest_pb.GasReading(
            concentration_ppm=concentration_ppm, stddev_ppm=stddev_ppm, sensor_index=sensor
        )
        return self._add(ingest_pb.Observation(gas=reading), time_ns, pose)

    def add_correction(self, time_ns: int, pose: Pose, anchors: Sequence[tuple[int, Pose]]) -> int:
        """Says that poses of before were wrong, as after a loop closure. anchors: (time_ns, pose)
        in order of time, of times at which something was observed; between them poses are
        interpolated, beyond them the way is moved rigidly. `pose` and those after it are right.
        Returns its number."""
        correction = ingest_pb.PoseCorrection()
        for anchor_time_ns, anchor_pose in anchors:
            correction.anchors.add(sample_time_ns=anchor_time_ns, pose=pose_of(anchor_pose))
        return self._add(ingest_pb.Observation(correction=correction), time_ns, pose)

    def add_status(self, time_ns: int, battery_share: float) -> int:
        """Numbers what the robot tells of itself: its battery, of a full one. Returns its
        number."""
        status = ingest_pb.RobotStatus(battery_share=battery_share)
        return self._add(ingest_pb.Observation(status=status), time_ns, None)

    def _add(self, observation: ingest_pb.Observation, time_ns: int, pose: Pose | None) -> int:
        observation.sample_time_ns = time_ns
        if pose is not None:
            observation.pose.CopyFrom(pose_of(pose))
        return self.log.add(observation)

    # How that gets to the server.

    def flush(self, timeout_s: float | None = None, stream: bool | None = None) -> Operation[None]:
        """Sends what waits as it is called: what is added meanwhile may stay for the next. Refused
        observations are added to `rejections`, and on_rejected is told of each. A server that lost
        what it had not on its disk, or was set back to older data, is told again what this client
        still has; what is gone is declared as a gap. Where it has lost the robot as it restarted,
        the robot registers again.

        What is not sent in time stays in the log. stream: over an ingest stream; default: if more
        waits than a batch takes."""
        through = self.log.last_sequence
        end_s = self._operations.end_s(timeout_s)
        backoff = Backoff()
        limits = yield from self._operations.limits()
        if stream is None:
            stream = self.log.is_longer_than(limits.max_batch_observation_count)
        while self.log.applied_sequence < through:
            try:
                if stream:
                    yield from self._send_stream(end_s, through)
                else:
                    yield from self._send_batch(end_s)
            except PlumeScoutError as error:
                if error.link_broke or error.passes_by_itself:
                    yield from pause(error, backoff, end_s)
                else:
                    yield from self._recover(error)
                    through = self.log.last_sequence  # its numbers may be others

    def _send_batch(self, end_s: float) -> Operation[None]:
        limits = yield from self._operations.limits()
        request = ingest_pb.BatchIngestObservationsRequest(
            open=self._open, batch=self.log.batch(limits, self.log.applied_sequence)
        )
        response = yield from self._operations.call(
            rpcs.BATCH_INGEST_OBSERVATIONS,
            request,
            left_s(end_s),
            before_try=lambda request: self._stamp(request.batch),
        )
        self._note(response.ingest_state)
        for rejection in response.rejections:
            self._reject(rejection)

    def _send_stream(self, end_s: float, through: int) -> Operation[None]:
        limits = yield from self._operations.limits()
        mission = self._request.mission.removeprefix("missions/")
        stream = yield Open(rpcs.STREAM_OBSERVATIONS, timeout_s=left_s(end_s), mission=mission)
        yield Write(stream, ingest_pb.StreamObservationsRequest(open=self._open))
        sent, credit, ending = 0, 0, False
        while (response := (yield Read(stream))) is not None:
            kind = response.WhichOneof("frame")
            if kind == "rejected":
                self._reject(response.rejected)
                continue
            state = response.opened.ingest_state if kind == "opened" else response.ack
            if kind == "opened":
                sent = state.applied_sequence
                if sent < self.log.applied_sequence:
                    self._go_back(sent)
            self._note(state)
            credit = max(credit, state.credit_sequence)
            while sent < through:
                batch = self.log.batch(limits, sent, credit).observations
                if not batch:
                    break
                frame = ingest_pb.StreamObservationsRequest()
                frame.batch.observations.extend(batch)
                self._stamp(frame.batch)
                yield Write(stream, frame)
                sent = last_sequence_of(batch[-1])
            if self.log.applied_sequence >= through and not ending:
                ending = True
                yield EndWriting(stream)
        if self.log.applied_sequence < through:
            raise PlumeScoutError(grpc.StatusCode.UNAVAILABLE, "the ingest stream ended")

    def _stamp(self, batch: ingest_pb.ObservationBatch) -> None:
        if self._clock_ns is not None:
            batch.sent_time_ns = self._clock_ns()

    def _note(self, state: ingest_pb.IngestState) -> None:
        self.log.note(state)
        self._open.durable_sequence = max(self._open.durable_sequence, state.durable_sequence)

    def _reject(self, rejected: ingest_pb.ObservationRejected) -> None:
        rejection = Rejection(rejected.sequence, rejected.status.message)
        self.rejections.append(rejection)
        del self.rejections[:-_KEPT_REJECTIONS]
        self._on_rejected(rejection)

    def _recover(self, error: PlumeScoutError) -> Operation[None]:
        """Makes up for what a server has lost, so that the call may be made again; raises `error`
        if that is not what is wrong."""
        if error.reason == "STORE_ROLLED_BACK":
            self._go_back(int(error.metadata.get("applied_sequence", 0)))
            return
        if error.reason == "SEQUENCE_GAP":  # or what it never called durable is gone
            request = ingest_pb.BatchIngestObservationsRequest(open=self._open)
            response = yield from self._operations.call(rpcs.BATCH_INGEST_OBSERVATIONS, request)
            applied = response.ingest_state.applied_sequence
            if applied < self.log.applied_sequence:
                self._go_back(applied)
                return
        elif error.reason in _LOST_REASONS:
            # Only a restart is made up for: whom an operator removes stays away.
            if (yield from self._operations.server_info()).boot_id != self._boot_id:
                yield from self._rejoin()
                return
        raise error

    def _rejoin(self) -> Operation[None]:
        self._request.request_id = ""
        self._request.take_over = False  # who has taken the robot over since keeps it
        registration = yield from self._operations.call(rpcs.REGISTER_ROBOT, self._request)
        self._boot_id = registration.server_boot_id
        applied = registration.ingest_state.applied_sequence
        if applied and not registration.log_continues:
            self.log.renumber(applied)
            self._open.durable_sequence = 0
        else:
            self._go_back(applied)
        self._open.lease_token = registration.lease_token

    def _go_back(self, applied_sequence: int) -> None:
        _LOGGER.warning(
            "%s: the server has gone back to observation %d", self.name, applied_sequence
        )
        self.log.go_back(applied_sequence)
        self._open.durable_sequence = min(self._open.durable_sequence, applied_sequence)

    def _warn(self, rejection: Rejection) -> None:
        _LOGGER.warning(
            "%s: observation %d refused: %s", self.name, rejection.sequence, rejection.message
        )


def _encode_ranges(ranges_m: npt.NDArray[np.float64]) -> tuple[npt.NDArray[np.float64], float]:
    seen = np.isfinite(ranges_m) & (ranges_m > 0)
    longest_m = float(ranges_m[seen].max(initial=0.0))
    unit_m = max(_RANGE_UNIT_M, longest_m / (_INVALID - 1))
    counts = np.full(ranges_m.shape, float(_INVALID))
    counts[seen] = np.clip(np.round(ranges_m[seen] / unit_m), 1, _INVALID - 1)
    counts[np.isposinf(ranges_m)] = _NO_RETURN
    return counts, unit_m
