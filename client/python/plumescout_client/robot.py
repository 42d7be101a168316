# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""One robot's part in a mission."""

import logging

import grpc
import numpy as np

from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import robot_service_pb2 as robot_pb

from .errors import PlumeScoutError, error_of
from .values import Plan, Rejection, _encode_ranges, _pose

_ROOM_FOR_OBSERVATIONS = 0.75  # of a request; the rest is for what goes around them
_LOG = logging.getLogger("plumescout_client")


class Robot:
    """One robot's part in a mission; made by Client.register. Not thread-safe."""

    def __init__(self, client, registration, on_rejected=None, clock_ns=None):
        self._client = client
        self._clock_ns = clock_ns
        self._on_rejected = on_rejected or self._warn
        self._open = ingest_pb.OpenIngest(
            robot=registration.robot, lease_token=registration.lease_token
        )
        # Observations that the server has not got, or not on its disk if it keeps anything there.
        self._kept = []
        # The log is a new one: it begins after whatever the server has of this robot.
        self.last_sequence = registration.ingest_state.applied_sequence
        self.applied_sequence = self.last_sequence
        self.durable_sequence = 0
        self.rejections = []

    def add_scan(self, time_ns, pose, ranges_m, start_angle_rad, angle_step_rad, max_range_m):
        """Numbers a scan. ranges_m: array; inf: nothing seen, NaN: the beam says nothing.
        Returns its number. Nothing is sent before flush or next_best_trajectory."""
        counts, unit_m = _encode_ranges(np.asarray(ranges_m, dtype=float))
        return self._add(
            time_ns,
            pose,
            scan=ingest_pb.LaserScan(
                start_angle_rad=start_angle_rad,
                angle_step_rad=angle_step_rad,
                max_range_m=max_range_m,
                range_unit_m=unit_m,
                ranges_u16=counts.astype("<u2").tobytes(),
            ),
        )

    def add_gas(self, time_ns, pose, concentration_ppm, stddev_ppm=0.0, sensor=0):
        """Numbers a gas reading; a deviation of 0 means that of the sensor, or the mission's model.
        sensor: its place among those that the robot registered. Returns its number."""
        reading = ingest_pb.GasReading(
            concentration_ppm=concentration_ppm, stddev_ppm=stddev_ppm, sensor_index=sensor
        )
        return self._add(time_ns, pose, gas=reading)

    def add_correction(self, time_ns, pose, anchors):
        """Says that poses of before were wrong, as after a loop closure. anchors: (time_ns, pose)
        in order of time, of times at which something was observed; between them poses are
        interpolated, beyond them the way is moved rigidly. `pose` and those after it are right.
        Returns its number."""
        correction = ingest_pb.PoseCorrection()
        for anchor_time_ns, anchor_pose in anchors:
            correction.anchors.add(sample_time_ns=anchor_time_ns, pose=_pose(anchor_pose))
        return self._add(time_ns, pose, correction=correction)

    def add_status(self, time_ns, battery_share):
        """Numbers what the robot tells of itself: its battery, of a full one. Returns its number."""
        return self._add(time_ns, None, status=ingest_pb.RobotStatus(battery_share=battery_share))

    def flush(self):
        """Sends what waits. Refused observations are added to `rejections`, and on_rejected is told
        of each. A server that lost what it had not on its disk, or was set back to older data, is
        told again what this client still has; what is gone is declared as a gap."""
        while self.applied_sequence < self.last_sequence:
            request = ingest_pb.BatchIngestObservationsRequest(
                open=self._open, batch=self._next_batch()
            )
            method = self._client._ingest.BatchIngestObservations
            try:
                response = self._client._call(method, request, before_try=self._stamp)
            except PlumeScoutError as error:
                self._go_back(self._position_after(error))
                continue
            self._note_state(response.ingest_state)
            rejections = [Rejection(r.sequence, r.status.message) for r in response.rejections]
            self.rejections += rejections
            for rejection in rejections:
                self._on_rejected(rejection)

    def next_best_trajectory(
        self, start=None, budget_s=1.0, seed=0, timeout_s=None, go_home=False
    ):
        """Sends what waits and asks for a plan that knows it: to the next goal, or home.

        start: pose; default: the latest, or where the robot will be (planning_latency_s).
        """
        request = planning_pb.NextBestTrajectoryRequest()
        self._order(request, start, budget_s, seed, go_home)
        method = self._client._planning.NextBestTrajectory
        return Plan(self._client._call_named(method, request, timeout_s).plan)

    def stream_trajectories(self, start=None, budget_s=1.0, seed=0, timeout_s=None, go_home=False):
        """As next_best_trajectory, but yields better and better plans; the last is the one to drive.

        Leaving the loop before its end cancels the search, and nothing is committed."""
        request = planning_pb.StreamNextBestTrajectoryRequest()
        self._order(request, start, budget_s, seed, go_home)
        method = self._client._planning.StreamNextBestTrajectory
        responses = self._client._call(method, request, timeout_s)
        try:
            for response in responses:
                yield Plan(response.plan)
        except grpc.RpcError as error:
            raise error_of(error) from None
        finally:
            responses.cancel()

    def check(self, plan):
        """Sends what waits and asks whether the rest of the robot's latest plan still holds.

        Returns a CheckTrajectoryResponse: blockage and rejected_goal are set if something is
        wrong with its way or its goal."""
        self.flush()
        request = planning_pb.CheckTrajectoryRequest(
            robot=self._open.robot,
            lease_token=self._open.lease_token,
            plan=plan.proto.name,
            min_applied_sequence=self.last_sequence,
        )
        return self._client._call(self._client._planning.CheckTrajectory, request)

    def list_frontiers(self):
        """Sends what waits; returns FrontierGoals: where this robot could go, and why not."""
        self.flush()
        request = planning_pb.ListFrontiersRequest(robot=self._open.robot)
        response = self._client._call(self._client._planning.ListFrontiers, request)
        return list(response.frontiers)

    def report(self, plan, outcome="reached"):
        """Says how a plan ended: "reached", "blocked" or "aborted"."""
        self.flush()
        request = planning_pb.ReportProgressRequest(
            robot=self._open.robot,
            lease_token=self._open.lease_token,
            plan=plan.proto.name,
            outcome=planning_pb.ReportProgressRequest.Outcome.Value(f"OUTCOME_{outcome.upper()}"),
        )
        self._client._call(self._client._planning.ReportProgress, request)

    def watch(self):
        """Yields what the robot has to know without having asked, as plumescout.v1.WatchRobotResponse:
        how it stands, that its plan does not stand, that it was given another. Blocks in between: give
        it a thread. It ends with an error; leaving the loop before cancels it."""
        return self._client._watch(self._open.robot, self._open.lease_token)

    def release(self):
        """Sends what waits and gives up the lease: another client may take the robot over at once.
        The robot stays in the mission."""
        self.flush()
        request = robot_pb.ReleaseLeaseRequest(
            robot=self._open.robot, lease_token=self._open.lease_token
        )
        self._client._call(self._client._robots.ReleaseLease, request)

    def leave(self):
        """Sends what waits and leaves the mission; registering again goes on with the log."""
        self.flush()
        request = robot_pb.RemoveRobotRequest(
            robot=self._open.robot, lease_token=self._open.lease_token
        )
        self._client._call(self._client._robots.RemoveRobot, request)

    def _stamp(self, request):
        if self._clock_ns is not None:
            request.batch.sent_time_ns = self._clock_ns()

    def _note_state(self, state):
        self.applied_sequence = state.applied_sequence
        self.durable_sequence = state.durable_sequence
        self._open.durable_sequence = max(self._open.durable_sequence, state.durable_sequence)
        # A server that keeps nothing on disk never calls anything durable.
        forget = state.durable_sequence or state.applied_sequence
        self._kept = [o for o in self._kept if _last_sequence(o) > forget]

    def _position_after(self, error):
        """What the server has of the log if that is less than it had; raises `error` otherwise."""
        if error.reason == "STORE_ROLLED_BACK":
            return int(error.metadata.get("applied_sequence", 0))
        if error.reason == "SEQUENCE_GAP":  # or what it never called durable is gone
            request = ingest_pb.BatchIngestObservationsRequest(open=self._open)
            method = self._client._ingest.BatchIngestObservations
            applied = self._client._call(method, request).ingest_state.applied_sequence
            if applied < self.applied_sequence:
                return applied
        raise error

    def _go_back(self, applied_sequence):
        _LOG.warning(
            "%s: the server has gone back to observation %d",
            self._open.robot,
            applied_sequence,
        )
        self.applied_sequence = self.durable_sequence = applied_sequence
        self._open.durable_sequence = applied_sequence
        self._kept = [o for o in self._kept if o.sequence > applied_sequence]
        first = self._kept[0].sequence if self._kept else self.last_sequence + 1
        if first > applied_sequence + 1:  # they are gone
            gap = ingest_pb.SequenceGap(
                first_sequence=applied_sequence + 1, last_sequence=first - 1
            )
            self._kept.insert(0, ingest_pb.Observation(sequence=gap.first_sequence, gap=gap))

    def _warn(self, rejection):
        _LOG.warning(
            "%s: observation %d refused: %s",
            self._open.robot,
            rejection.sequence,
            rejection.message,
        )

    def _order(self, request, start, budget_s, seed, go_home):
        self.flush()
        request.robot = self._open.robot
        request.lease_token = self._open.lease_token
        request.min_applied_sequence = self.last_sequence
        request.seed = seed
        request.go_home = go_home
        request.planning_budget.FromNanoseconds(round(budget_s * 1e9))
        if start is not None:
            request.start.CopyFrom(_pose(start))

    def _add(self, time_ns, pose, **payload):
        self.last_sequence += 1
        observation = ingest_pb.Observation(
            sequence=self.last_sequence, sample_time_ns=time_ns, **payload
        )
        if pose is not None:
            observation.pose.CopyFrom(_pose(pose))
        self._kept.append(observation)
        return self.last_sequence

    def _next_batch(self):
        limits = self._client.limits
        batch, size = ingest_pb.ObservationBatch(), 0
        waiting = [o for o in self._kept if _last_sequence(o) > self.applied_sequence]
        for observation in waiting[: limits.max_batch_observation_count]:
            size += observation.ByteSize()
            if batch.observations and size > limits.max_receive_bytes * _ROOM_FOR_OBSERVATIONS:
                break
            batch.observations.append(observation)
        return batch


def _last_sequence(observation):
    """The last number that an entry of the log stands for."""
    if observation.HasField("gap"):
        return observation.gap.last_sequence
    return observation.sequence
