# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A small client of the PlumeScout server for scripts and notebooks.

    with plumescout_client.Client("127.0.0.1:50551") as client:
        client.create_mission("house", exist_ok=True)
        robot = client.register("house", "scout")
        robot.add_scan(time_ns, pose, ranges_m, start_angle_rad, angle_step_rad, max_range_m)
        robot.add_gas(time_ns, pose, concentration_ppm)
        plan = robot.next_best_trajectory()
        ...drive along plan.poses...
        robot.report(plan, "reached")
        gas_ppm = client.get_map("house").gas_mean_ppm

Poses are (x_m, y_m, yaw_rad) in frame map. Observations are kept until the server has applied them;
a robot that must outlive a restart of the server is better served by the program plumescout-robot.
The generated stubs (plumescout.v1, google.rpc) must be on PYTHONPATH: build/release/python.
"""

import base64
import dataclasses
import logging
import pathlib
import re
import zlib

import grpc
import numpy as np
from google.protobuf import json_format
from google.rpc import error_details_pb2, status_pb2

from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import ingest_service_pb2_grpc as ingest_grpc
from plumescout.v1 import map_service_pb2 as map_pb
from plumescout.v1 import map_service_pb2_grpc as map_grpc
from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import mission_service_pb2_grpc as mission_grpc
from plumescout.v1 import options_pb2 as options_pb
from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import planning_service_pb2_grpc as planning_grpc
from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import robot_service_pb2_grpc as robot_grpc
from plumescout.v1 import types_pb2 as types_pb

UNKNOWN, FREE, OCCUPIED = 0, 1, 2  # values of Map.occupancy

_KEEPALIVE_TIME_MS = 10_000  # matches the server's minimum ping interval
_KEEPALIVE_TIMEOUT_MS = 5_000
_MAX_RECEIVE_BYTES = 256 << 20  # the largest map
_MAX_REQUEST_BYTES = 192 << 10  # below the server's receive limit
_MAX_BATCH_OBSERVATIONS = 512
_RANGE_UNIT_M = 0.005
_NO_RETURN, _INVALID = 0, 65535  # counts of ranges_u16 with a meaning of their own
_LOG = logging.getLogger(__name__)
_DETAILS_KEY = "grpc-status-details-bin"


class PlumeScoutError(Exception):
    """An error of the server: code is a grpc.StatusCode, reason an UPPER_SNAKE word or ''."""

    def __init__(self, code, message, reason=""):
        super().__init__(f"{code.name}: {message}")
        self.code = code
        self.reason = reason


@dataclasses.dataclass(frozen=True)
class Rejection:
    """An observation that the server refused; it counts as applied."""

    sequence: int
    message: str


@dataclasses.dataclass(frozen=True)
class Plan:
    """The answer to "where next"; `proto` holds all candidates with their costs."""

    proto: planning_pb.Plan

    @property
    def complete(self):
        return self.proto.phase == types_pb.MISSION_PHASE_COMPLETE

    @property
    def explanation(self):
        return self.proto.explanation

    @property
    def poses(self):
        """Way points as an array of shape (n, 3): x_m, y_m, yaw_rad; the first is the start."""
        points = self.proto.trajectory.waypoints
        return np.array([(p.pose.x_m, p.pose.y_m, p.pose.yaw_rad) for p in points]).reshape(-1, 3)

    @property
    def arrival_s(self):
        """Arrival at each way point, seconds since departure."""
        return np.array([p.arrival_time_s for p in self.proto.trajectory.waypoints])

    @property
    def dwell_s(self):
        """Standing time at each way point."""
        return np.array([p.dwell_s for p in self.proto.trajectory.waypoints])


@dataclasses.dataclass(frozen=True)
class Map:
    """A map at one revision. Arrays have shape (rows, columns), row 0 in the south."""

    revision: int
    status: map_pb.MapStatus  # geometry, frontiers, robots, counters, phase
    occupancy: np.ndarray  # uint8: UNKNOWN, FREE or OCCUPIED
    gas_mean_ppm: np.ndarray  # float32, NaN off free cells
    gas_variance_ppm2: np.ndarray  # float32, NaN off free cells

    def cell(self, x_m, y_m):
        """(row, column) of a point; it may lie outside the arrays."""
        geometry = self.status.geometry
        return (
            int(np.floor((y_m - geometry.origin.y_m) / geometry.resolution_m)),
            int(np.floor((x_m - geometry.origin.x_m) / geometry.resolution_m)),
        )


class Client:
    """One connection to a server. Its calls raise PlumeScoutError."""

    def __init__(self, target="127.0.0.1:50551", timeout_s=10.0):
        self._channel = grpc.insecure_channel(
            target,
            options=[
                ("grpc.keepalive_time_ms", _KEEPALIVE_TIME_MS),
                ("grpc.keepalive_timeout_ms", _KEEPALIVE_TIMEOUT_MS),
                ("grpc.max_receive_message_length", _MAX_RECEIVE_BYTES),
            ],
        )
        self._timeout_s = timeout_s
        self._missions = mission_grpc.MissionServiceStub(self._channel)
        self._robots = robot_grpc.RobotServiceStub(self._channel)
        self._ingest = ingest_grpc.IngestServiceStub(self._channel)
        self._planning = planning_grpc.PlanningServiceStub(self._channel)
        self._maps = map_grpc.MapServiceStub(self._channel)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._channel.close()

    def create_mission(self, mission, options=None, exist_ok=False):
        """options: nested dict of plumescout.v1.MissionOptions, e.g.
        {"planning": {"speed_mps": 0.5}}; what is left out takes the server's default. A known
        building goes under "prior_map", see prior_map and prior_map_of_files."""
        request = mission_pb.CreateMissionRequest(
            mission_id=mission,
            options=json_format.ParseDict(options or {}, options_pb.MissionOptions()),
        )
        try:
            self._call(self._missions.CreateMission, request)
        except PlumeScoutError as error:
            if not (exist_ok and error.code == grpc.StatusCode.ALREADY_EXISTS):
                raise

    def list_missions(self):
        names, token = [], ""
        while True:
            request = mission_pb.ListMissionsRequest(page_token=token)
            response = self._call(self._missions.ListMissions, request)
            names += [mission.name.removeprefix("missions/") for mission in response.missions]
            token = response.next_page_token
            if not token:
                return names

    def delete_mission(self, mission):
        request = mission_pb.DeleteMissionRequest(name=f"missions/{mission}")
        self._call(self._missions.DeleteMission, request)

    def register(self, mission, robot, radius_m=0.2, take_over=False, on_rejected=None):
        """Joins a mission, or comes back to it; returns a Robot.

        on_rejected is called with the Rejection of each observation that the server refuses, from
        within the call that sent it; default: a warning of the logger "plumescout_client"."""
        request = robot_pb.RegisterRobotRequest(
            mission=f"missions/{mission}", robot_id=robot, radius_m=radius_m, take_over=take_over
        )
        return Robot(self, self._call(self._robots.RegisterRobot, request), on_rejected)

    def remove_robot(self, mission, robot):
        """Removes a robot whoever holds its lease, as one that died; see Robot.leave."""
        request = robot_pb.RemoveRobotRequest(
            robot=f"missions/{mission}/robots/{robot}", force=True
        )
        self._call(self._robots.RemoveRobot, request)

    def get_map(self, mission):
        request = map_pb.GetMapRequest(
            mission=f"missions/{mission}", full_precision=True, fresh_posterior=True
        )
        return _map_from_proto(self._call(self._maps.GetMap, request))

    def query_gas(self, mission, points):
        """What the gas field says at points, an array of shape (n, 2): x_m, y_m.

        Returns mean (ppm) and variance (ppm^2), each of shape (n,), NaN off free cells."""
        request = map_pb.QueryGasRequest(
            mission=f"missions/{mission}", points=_points(points), fresh_posterior=True
        )
        gas = self._call(self._maps.QueryGas, request).gas
        mean_ppm = [g.mean_ppm if g.HasField("mean_ppm") else np.nan for g in gas]
        variance_ppm2 = [g.variance_ppm2 if g.HasField("variance_ppm2") else np.nan for g in gas]
        return np.array(mean_ppm), np.array(variance_ppm2)

    def _call(self, method, request, timeout_s=None):
        try:
            return method(request, timeout=timeout_s or self._timeout_s, wait_for_ready=True)
        except grpc.RpcError as error:
            raise PlumeScoutError(error.code(), error.details(), _reason(error)) from None


def prior_map(occupancy, resolution_m, origin_m=(0.0, 0.0)):
    """A known building for create_mission({"prior_map": ...}).

    occupancy: array of UNKNOWN, FREE and OCCUPIED, shape (rows, columns), row 0 in the south;
    origin_m: its south-west corner, whole multiples of the resolution, which is the mission's
    occupancy.resolution_m."""
    cells = np.asarray(occupancy, dtype=np.uint8)
    rows, columns = cells.shape
    return {
        "cells": {
            "geometry": {
                "origin": {"x_m": origin_m[0], "y_m": origin_m[1]},
                "resolution_m": resolution_m,
                "column_count": columns,
                "row_count": rows,
            },
            "deflated_data": base64.b64encode(zlib.compress(cells.tobytes())).decode(),
        }
    }


def prior_map_of_files(yaml_path):
    """The same from the files of ROS map_server: a YAML file and the PGM image that it names. An
    image beyond the server's limits.max_receive_bytes has to go through prior_map."""
    yaml_path = pathlib.Path(yaml_path)
    yaml = yaml_path.read_text()
    image = re.search(r"^image:\s*(.+?)\s*$", yaml, re.MULTILINE)
    if image is None:
        raise ValueError(f"{yaml_path} names no image")
    pgm = (yaml_path.parent / image.group(1).strip("'\"")).read_bytes()
    return {"files": {"yaml": yaml, "pgm": base64.b64encode(pgm).decode()}}


class Robot:
    """One robot's part in a mission; made by Client.register. Not thread-safe."""

    def __init__(self, client, registration, on_rejected=None):
        self._client = client
        self._on_rejected = on_rejected or self._warn
        self._open = ingest_pb.OpenIngest(
            robot=registration.robot, lease_token=registration.lease_token
        )
        self._waiting = []  # observations that the server has not applied
        self.last_sequence = registration.ingest_state.applied_sequence
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

    def add_gas(self, time_ns, pose, concentration_ppm, stddev_ppm=0.0):
        """Numbers a gas reading; a deviation of 0 means the mission's model. Returns its number."""
        reading = ingest_pb.GasReading(concentration_ppm=concentration_ppm, stddev_ppm=stddev_ppm)
        return self._add(time_ns, pose, gas=reading)

    def flush(self):
        """Sends what waits. Refused observations are added to `rejections`, and on_rejected is told
        of each."""
        while self._waiting:
            request = ingest_pb.BatchIngestObservationsRequest(
                open=self._open, batch=self._next_batch()
            )
            response = self._client._call(
                self._client._ingest.BatchIngestObservations, request
            )
            applied = response.ingest_state.applied_sequence
            self._waiting = [o for o in self._waiting if o.sequence > applied]
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
        return Plan(self._client._call(method, request, timeout_s).plan)

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
            raise PlumeScoutError(error.code(), error.details(), _reason(error)) from None
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

    def leave(self):
        """Sends what waits and leaves the mission; registering again goes on with the log."""
        self.flush()
        request = robot_pb.RemoveRobotRequest(
            robot=self._open.robot, lease_token=self._open.lease_token
        )
        self._client._call(self._client._robots.RemoveRobot, request)

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
        self._waiting.append(
            ingest_pb.Observation(
                sequence=self.last_sequence, sample_time_ns=time_ns, pose=_pose(pose), **payload
            )
        )
        return self.last_sequence

    def _next_batch(self):
        batch, size = ingest_pb.ObservationBatch(), 0
        for observation in self._waiting[:_MAX_BATCH_OBSERVATIONS]:
            size += observation.ByteSize()
            if batch.observations and size > _MAX_REQUEST_BYTES:
                break
            batch.observations.append(observation)
        return batch


def _pose(pose):
    x_m, y_m, yaw_rad = pose
    return types_pb.Pose2D(x_m=x_m, y_m=y_m, yaw_rad=yaw_rad)


def _points(points):
    return [types_pb.Point2D(x_m=x_m, y_m=y_m) for x_m, y_m in points]


def _encode_ranges(ranges_m):
    seen = np.isfinite(ranges_m) & (ranges_m > 0)
    longest_m = ranges_m[seen].max(initial=0.0)
    unit_m = max(_RANGE_UNIT_M, longest_m / (_INVALID - 1))
    counts = np.full(ranges_m.shape, _INVALID)
    counts[seen] = np.clip(np.round(ranges_m[seen] / unit_m), 1, _INVALID - 1)
    counts[np.isposinf(ranges_m)] = _NO_RETURN
    return counts, unit_m


def _map_from_proto(response):
    geometry = response.status.geometry
    shape = (geometry.row_count, geometry.column_count)
    layers = {
        map_pb.MAP_LAYER_OCCUPANCY: np.full(shape, UNKNOWN, np.uint8),
        map_pb.MAP_LAYER_GAS_MEAN: np.full(shape, np.nan, np.float32),
        map_pb.MAP_LAYER_GAS_VARIANCE: np.full(shape, np.nan, np.float32),
    }
    for tile in response.tiles:
        row, column = tile.min_cell.row, tile.min_cell.column
        layers[tile.layer][row : row + tile.row_count, column : column + tile.column_count] = (
            _decode_tile(tile)
        )
    return Map(
        revision=response.revision,
        status=response.status,
        occupancy=layers[map_pb.MAP_LAYER_OCCUPANCY],
        gas_mean_ppm=layers[map_pb.MAP_LAYER_GAS_MEAN],
        gas_variance_ppm2=layers[map_pb.MAP_LAYER_GAS_VARIANCE],
    )


def _decode_tile(tile):
    dtype = {
        map_pb.MapTile.ENCODING_U8: np.dtype("u1"),
        map_pb.MapTile.ENCODING_F32: np.dtype("<f4"),
    }[tile.encoding]  # the only ones that get_map asks for
    cells = np.frombuffer(zlib.decompress(tile.deflated_data), dtype)
    return cells.reshape(tile.row_count, tile.column_count)


def _reason(error):
    details = status_pb2.Status()
    for key, value in error.trailing_metadata() or ():
        if key == _DETAILS_KEY:
            details.ParseFromString(value)
    for detail in details.details:
        info = error_details_pb2.ErrorInfo()
        if detail.Unpack(info):
            return info.reason
    return ""
