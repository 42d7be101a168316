# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""One robot's part in a mission, as operations."""

from __future__ import annotations

from typing import Any

import numpy.typing as npt

from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import types_pb2 as types_pb

from . import rpcs
from ._ingest import Ingest
from ._operation import Emit, Open, Operation, Read
from .errors import PlumeScoutError
from .plans import Plan, Pose, plan_of, points_of, pose_of


class Session(Ingest):
    """What a robot asks for. Everything sends first what waits in its log."""

    def next_best_trajectory(
        self,
        start: Pose | None = None,
        budget_s: float = 1.0,
        seed: int = 0,
        timeout_s: float | None = None,
        go_home: bool = False,
    ) -> Operation[Plan]:
        """Sends what waits and asks for a plan that knows it: to the next goal, or home.

        start: pose; default: the latest, or where the robot will be (planning_latency_s).
        """
        request = planning_pb.NextBestTrajectoryRequest()
        yield from self._order(request, start, budget_s, seed, go_home)
        try:
            response = yield from self._call(rpcs.NEXT_BEST_TRAJECTORY, request, timeout_s)
        except PlumeScoutError as error:
            yield from self._recover(error)
            yield from self._order(request, start, budget_s, seed, go_home)
            response = yield from self._call(rpcs.NEXT_BEST_TRAJECTORY, request, timeout_s)
        return plan_of(response.plan)

    def stream_trajectories(
        self,
        start: Pose | None = None,
        budget_s: float = 1.0,
        seed: int = 0,
        timeout_s: float | None = None,
        go_home: bool = False,
    ) -> Operation[None]:
        """As next_best_trajectory, but better and better plans come, one after the other; the last
        is the one to drive. Leaving the loop before its end cancels the search, and nothing is
        committed."""
        request = planning_pb.StreamNextBestTrajectoryRequest()
        yield from self._order(request, start, budget_s, seed, go_home)
        timeout_s = self._operations.timeout_s if timeout_s is None else timeout_s
        stream = yield Open(rpcs.STREAM_NEXT_BEST_TRAJECTORY, request, timeout_s)
        while (response := (yield Read(stream))) is not None:
            yield Emit(plan_of(response.plan))

    def check(self, plan: Plan) -> Operation[planning_pb.CheckTrajectoryResponse]:
        """Sends what waits and asks whether the rest of the robot's latest plan still holds:
        blockage and rejected_goal are set if something is wrong with its way or its goal."""
        request = planning_pb.CheckTrajectoryRequest(plan=plan.name)
        return (yield from self._check(request))

    def check_path(
        self, points: npt.ArrayLike, goal_kind: str
    ) -> Operation[planning_pb.CheckTrajectoryResponse]:
        """The same of a path of its own: an array of shape (n, 2), x_m, y_m, and what waits at its
        end, such as "occupancy_frontier" or "home"."""
        request = planning_pb.CheckTrajectoryRequest()
        request.path.vertices.extend(points_of(points))
        request.path.goal_kind = types_pb.GoalKind.Value(f"GOAL_KIND_{goal_kind.upper()}")
        return (yield from self._check(request))

    def _check(
        self, request: planning_pb.CheckTrajectoryRequest
    ) -> Operation[planning_pb.CheckTrajectoryResponse]:
        yield from self.flush()
        request.min_applied_sequence = self.log.applied_sequence
        return (yield from self._call(rpcs.CHECK_TRAJECTORY, request))

    def list_frontiers(self) -> Operation[list[planning_pb.FrontierGoal]]:
        """Sends what waits; says where this robot could go, and why not."""
        yield from self.flush()
        request = planning_pb.ListFrontiersRequest(robot=self.name)
        response = yield from self._operations.call(rpcs.LIST_FRONTIERS, request)
        return list(response.frontiers)

    def report(self, plan: Plan, outcome: str = "reached") -> Operation[None]:
        """Says how a plan ended: "reached", "blocked" or "aborted"."""
        yield from self.flush()
        request = planning_pb.ReportProgressRequest(
            plan=plan.name,
            outcome=planning_pb.ReportProgressRequest.Outcome.Value(f"OUTCOME_{outcome.upper()}"),
        )
        yield from self._call(rpcs.REPORT_PROGRESS, request)

    def watch(self) -> Operation[None]:
        """What the robot has to know without having asked, one plumescout.v1.WatchRobotResponse
        after the other: how it stands, that its plan does not stand, that it was given another.
        Leaving the loop ends it; a link that breaks is made again."""
        request = robot_pb.WatchRobotRequest(robot=self.name, lease_token=self._open.lease_token)
        return self._operations.follow(rpcs.WATCH_ROBOT, request)

    def release(self) -> Operation[None]:
        """Sends what waits and gives up the lease: another client may take the robot over at once.
        The robot stays in the mission."""
        yield from self.flush()
        yield from self._call(rpcs.RELEASE_LEASE, robot_pb.ReleaseLeaseRequest())

    def leave(self) -> Operation[None]:
        """Sends what waits and leaves the mission; registering again goes on with the log."""
        yield from self.flush()
        yield from self._call(rpcs.REMOVE_ROBOT, robot_pb.RemoveRobotRequest())

    def _call(
        self, rpc: rpcs.Rpc[Any, rpcs.Response], request: Any, timeout_s: float | None = None
    ) -> Operation[rpcs.Response]:
        request.robot, request.lease_token = self.name, self._open.lease_token
        return self._operations.call(rpc, request, timeout_s)

    def _order(
        self, request: Any, start: Pose | None, budget_s: float, seed: int, go_home: bool
    ) -> Operation[None]:
        yield from self.flush()
        request.robot = self.name
        request.lease_token = self._open.lease_token
        request.min_applied_sequence = self.log.applied_sequence
        request.seed = seed
        request.go_home = go_home
        request.planning_budget.FromNanoseconds(round(budget_s * 1e9))
        if start is not None:
            request.start.CopyFrom(pose_of(start))
