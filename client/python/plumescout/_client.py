# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What can be asked of a server about robots, plans and maps, as operations."""

from __future__ import annotations

import itertools
import secrets
import time
from collections.abc import Callable, Sequence

import grpc
import numpy as np
import numpy.typing as npt

from plumescout.v1 import map_service_pb2 as map_pb
from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import types_pb2 as types_pb

from . import rpcs
from ._log import MAX_KEPT_BYTES, Rejection
from ._missions import MissionOperations, mission_name
from ._operation import Operation
from ._session import Session
from .errors import PlumeScoutError
from .maps import Map, MapBuilder, layers_of
from .plans import points_of, pose_of

_MAP_ATTEMPTS = 5
_LOG_EPOCH_END = 1 << 53

Region = tuple[float, float, float, float]


class Operations(MissionOperations):
    """All of one connection."""

    # Robots.

    def register(
        self,
        mission: str,
        robot: str,
        radius_m: float = 0.2,
        take_over: bool = False,
        on_rejected: Callable[[Rejection], None] | None = None,
        frame: tuple[float, float, float] | None = None,
        frame_stddev: tuple[float, float] = (0.0, 0.0),
        clock_ns: Callable[[], int] | None = time.time_ns,
        gas_sensors: Sequence[robot_pb.GasSensor] = (),
        max_kept_bytes: int = MAX_KEPT_BYTES,
    ) -> Operation[Session]:
        """Joins a mission, or comes back to it; returns a Robot.

        frame: (x_m, y_m, yaw_rad) of the origin of the robot's own frame in the mission's, for its
        observations are in that, and standard deviations in metres and radians. Starts and plans
        are in the mission's frame.

        gas_sensors: plumescout.v1.GasSensor of each sensor, to which readings refer by their place;
        none: one, calibrated, at the robot's pose.

        clock_ns tells the robot's time now, by the clock that its samples have their times of: the
        server learns from it how far that clock is off. None: it is taken as it is, as of
        simulations that do not keep real time.

        on_rejected is called with the Rejection of each observation that the server refuses, from
        within the call that sent it; default: a warning of the logger "plumescout".

        max_kept_bytes: bound on what is kept of observations that the server has not on its disk;
        beyond it the oldest go."""
        request = robot_pb.RegisterRobotRequest(
            mission=mission_name(mission),
            robot_id=robot,
            radius_m=radius_m,
            take_over=take_over,
            log_epoch=1 + secrets.randbelow(_LOG_EPOCH_END - 1),
            gas_sensors=gas_sensors,
        )
        if frame is not None:
            request.frame.mission_from_robot.CopyFrom(pose_of(frame))
            request.frame.position_stddev_m, request.frame.heading_stddev_rad = frame_stddev
        registration = yield from self.call(rpcs.REGISTER_ROBOT, request)
        return Session(self, request, registration, on_rejected, clock_ns, max_kept_bytes)

    def robots(self, mission: str) -> Operation[list[robot_pb.Robot]]:
        """The robots of a mission."""
        request = robot_pb.ListRobotsRequest(mission=mission_name(mission))
        pages = yield from self.pages(rpcs.LIST_ROBOTS, request)
        return [robot for page in pages for robot in page.robots]

    def get_robot(self, mission: str, robot: str) -> Operation[robot_pb.Robot]:
        request = robot_pb.GetRobotRequest(name=_robot(mission, robot))
        return (yield from self.call(rpcs.GET_ROBOT, request)).robot

    def watch_robot(self, mission: str, robot: str) -> Operation[None]:
        """What there is to tell of a robot, one plumescout.v1.WatchRobotResponse after the other,
        whoever holds its lease; see Robot.watch."""
        return self.follow(
            rpcs.WATCH_ROBOT, robot_pb.WatchRobotRequest(robot=_robot(mission, robot))
        )

    def release_lease(self, mission: str, robot: str) -> Operation[None]:
        """Frees a robot's lease whoever holds it, as of a client that died; see Robot.release."""
        request = robot_pb.ReleaseLeaseRequest(robot=_robot(mission, robot), force=True)
        yield from self.call(rpcs.RELEASE_LEASE, request)

    def remove_robot(self, mission: str, robot: str) -> Operation[None]:
        """Removes a robot whoever holds its lease, as one that died; see Robot.leave."""
        request = robot_pb.RemoveRobotRequest(robot=_robot(mission, robot), force=True)
        yield from self.call(rpcs.REMOVE_ROBOT, request)

    def order_home(
        self, mission: str, robot: str | None = None, home: bool = True
    ) -> Operation[None]:
        """Sends a robot home, or all of the mission; home=False: they need not go any more."""
        request = robot_pb.OrderHomeRequest(home=home)
        if robot is None:
            request.mission = mission_name(mission)
        else:
            request.robot = _robot(mission, robot)
        yield from self.call(rpcs.ORDER_HOME, request)

    # Plans.

    def live_plans(self, mission: str) -> Operation[list[planning_pb.LivePlan]]:
        """Where its robots are on their way to."""
        request = planning_pb.ListPlansRequest(mission=mission_name(mission))
        return list((yield from self.call(rpcs.LIST_PLANS, request)).plans)

    def plan_team(
        self,
        mission: str,
        robots: Sequence[str] = (),
        go_home: bool = False,
        budget_s: float | None = None,
        max_orders: int = 0,
        seed: int = 0,
        timeout_s: float | None = None,
    ) -> Operation[planning_pb.PlanTeamResponse]:
        """Plans for several robots at once, by default for all that are free, which then fetch
        them with next_best_trajectory."""
        request = planning_pb.PlanTeamRequest(
            mission=mission_name(mission),
            robots=[_robot(mission, robot) for robot in robots],
            go_home=go_home,
            max_order_count=max_orders,
            seed=seed,
        )
        if budget_s is not None:
            request.planning_budget.FromNanoseconds(round(budget_s * 1e9))
        return self.call(rpcs.PLAN_TEAM, request, timeout_s)

    # Maps.

    def get_map(
        self,
        mission: str,
        region: Region | None = None,
        level_of_detail: int = 0,
        revision: int = 0,
        species: str | None = None,
        layers: Sequence[str] = (),
        full_precision: bool = True,
        max_part_bytes: int = 0,
    ) -> Operation[Map]:
        """The map of a mission, as it is, or as it was at a revision.

        region: (min_x_m, min_y_m, max_x_m, max_y_m); what its tiles do not cover stays UNKNOWN and
        NaN. level_of_detail: squares of 2**n by 2**n cells make one, n up to 6: the worst of their
        states, their largest values. species: which of the mission's gases, by name; default: the
        first. layers: of "occupancy", "gas-mean" and "gas-variance"; default: all. Without
        full_precision gas comes in steps of 1/65535 of its range. max_part_bytes: of one message.
        """
        request = map_pb.GetMapRequest(
            mission=mission_name(mission),
            layers=layers_of(layers),
            full_precision=full_precision,
            fresh_posterior=True,
            level_of_detail=level_of_detail,
            max_part_bytes=max_part_bytes,
            revision=revision,
            species=[species] if species else [],
        )
        if region is not None:
            request.region.CopyFrom(_region(region))
        for attempt in itertools.count(1):
            try:
                return (yield from self._map_of_parts(request))
            except PlumeScoutError as error:  # the map has changed too much between its parts
                if error.code != grpc.StatusCode.ABORTED or attempt == _MAP_ATTEMPTS:
                    raise
        raise AssertionError("not reached")

    def _map_of_parts(self, request: map_pb.GetMapRequest) -> Operation[Map]:
        builder = MapBuilder()
        request.part_token = ""
        while True:
            part = yield from self.call(rpcs.GET_MAP, request)
            builder.add(part)
            request.part_token = part.next_part_token
            if not request.part_token:
                return builder.map(part.revision)

    def watch_map(
        self,
        mission: str,
        region: Region | None = None,
        level_of_detail: int = 0,
        species: str | None = None,
        layers: Sequence[str] = (),
        full_precision: bool = True,
        from_revision: int | None = None,
        speed_ratio: float = 1.0,
    ) -> Operation[None]:
        """The map now, then again after every change, one Map after the other; who is slow gets the
        newest. A link that breaks is made again. Arguments are as of get_map; from_revision: what
        happened since comes first, speed_ratio times as fast as it did."""
        request = map_pb.WatchMapRequest(
            mission=mission_name(mission),
            layers=layers_of(layers),
            full_precision=full_precision,
            level_of_detail=level_of_detail,
            speed_ratio=speed_ratio,
            species=[species] if species else [],
        )
        if region is not None:
            request.region.CopyFrom(_region(region))
        if from_revision is not None:
            request.from_revision = from_revision
        return self.follow(rpcs.WATCH_MAP, request, MapBuilder().watched)

    def query_gas(
        self,
        mission: str,
        points: npt.ArrayLike,
        species: str | None = None,
        revision: int = 0,
    ) -> Operation[tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]]:
        """What the gas field says at points, an array of shape (n, 2): x_m, y_m. species, revision:
        as of get_map.

        Returns mean (ppm) and variance (ppm^2), each of shape (n,), NaN off free cells."""
        gas = (yield from self._gas_at(mission, points, species, revision)).gas
        mean_ppm = [g.mean_ppm if g.HasField("mean_ppm") else np.nan for g in gas]
        variance_ppm2 = [g.variance_ppm2 if g.HasField("variance_ppm2") else np.nan for g in gas]
        return np.array(mean_ppm), np.array(variance_ppm2)

    def nearest_readings(
        self,
        mission: str,
        points: npt.ArrayLike,
        species: str | None = None,
        revision: int = 0,
    ) -> Operation[tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]]:
        """Where and when gas was measured last around points; arguments as of query_gas.

        Returns distance (m) of the nearest reading and its age (s) at the newest sample of any
        robot, each of shape (n,), NaN where there is none."""
        answer = yield from self._gas_at(mission, points, species, revision)
        distance_m = [
            g.nearest_reading_m if g.HasField("nearest_reading_m") else np.nan for g in answer.gas
        ]
        age_s = [
            (answer.sample_time_ns - g.nearest_reading_time_ns) / 1e9
            if g.HasField("nearest_reading_time_ns")
            else np.nan
            for g in answer.gas
        ]
        return np.array(distance_m), np.array(age_s)

    def _gas_at(
        self, mission: str, points: npt.ArrayLike, species: str | None, revision: int
    ) -> Operation[map_pb.QueryGasResponse]:
        request = map_pb.QueryGasRequest(
            mission=mission_name(mission),
            points=points_of(points),
            fresh_posterior=True,
            species=species or "",
            revision=revision,
        )
        return (yield from self.call(rpcs.QUERY_GAS, request))


def _robot(mission: str, robot: str) -> str:
    return f"{mission_name(mission)}/robots/{robot}"


def _region(region: Region) -> map_pb.MapRegion:
    min_x_m, min_y_m, max_x_m, max_y_m = region
    return map_pb.MapRegion(
        min=types_pb.Point2D(x_m=min_x_m, y_m=min_y_m),
        max=types_pb.Point2D(x_m=max_x_m, y_m=max_y_m),
    )
