# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Plans: where to drive next, and why."""

from __future__ import annotations

import dataclasses
import math
from typing import Any, Iterator

import numpy as np
import numpy.typing as npt

from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import types_pb2 as types_pb

Pose = tuple[float, float, float]  # x_m, y_m, yaw_rad


@dataclasses.dataclass(frozen=True, eq=False)
class Plan:
    """The answer to "where next". Poses are in the mission's frame."""

    name: str  # missions/{mission}/plans/{number}; "" before it is committed
    robot: str  # missions/{mission}/robots/{robot}
    phase: str  # of the mission: "exploring", "gas_probing", "complete" ...
    end: str  # how the search ended: "all_goals_reached", "no_goals" ...
    goal_kind: str  # "occupancy_frontier", "information", "home" ...; "" to stay
    poses: npt.NDArray[
        np.float64
    ]  # (n, 3): x_m, y_m, yaw_rad of way points; the first is the start
    arrival_s: npt.NDArray[np.float64]  # (n,): since departure
    dwell_s: npt.NDArray[np.float64]  # (n,): standing time at each
    speed_mps: npt.NDArray[np.float64]  # (n,): in passing; 0 where the robot stands or speed jumps
    length_m: float
    duration_s: float
    explanation: str  # one sentence
    proto: planning_pb.Plan  # all candidates with their costs, rejected goals, effort

    @property
    def complete(self) -> bool:
        """The mission is complete: nothing is left to drive to."""
        return self.phase == "complete"

    def every(self, step_m: float) -> Iterator[Pose]:
        """Poses on the way, at most so far apart, with the heading of their leg; without the first,
        where the robot stands. Way points are among them."""
        for (x_m, y_m, _), (end_x_m, end_y_m, yaw_rad) in zip(self.poses, self.poses[1:]):
            steps = 1 + int(math.dist((x_m, y_m), (end_x_m, end_y_m)) / step_m)
            for share in (step / steps for step in range(1, steps + 1)):
                yield (
                    float(x_m + share * (end_x_m - x_m)),
                    float(y_m + share * (end_y_m - y_m)),
                    float(yaw_rad),
                )

    def __bool__(self) -> bool:
        """Whether there is anywhere to drive."""
        return len(self.poses) > 1


def plan_of(proto: planning_pb.Plan) -> Plan:
    waypoints = proto.trajectory.waypoints
    rows = [(w.pose.x_m, w.pose.y_m, w.pose.yaw_rad) for w in waypoints]
    chosen = proto.chosen_index
    goal_kind = (
        proto.candidates[chosen].goal.kind if chosen >= 0 else types_pb.GOAL_KIND_UNSPECIFIED
    )
    return Plan(
        name=proto.name,
        robot=proto.robot,
        phase=word(types_pb.MissionPhase, proto.phase),
        end=word(planning_pb.Plan.End, proto.end),
        goal_kind=word(types_pb.GoalKind, goal_kind) if chosen >= 0 else "",
        poses=_frozen(rows).reshape(-1, 3),
        arrival_s=_frozen([w.arrival_time_s for w in waypoints]),
        dwell_s=_frozen([w.dwell_s for w in waypoints]),
        speed_mps=_frozen([w.speed_mps for w in waypoints]),
        length_m=proto.trajectory.length_m,
        duration_s=proto.trajectory.duration_s,
        explanation=proto.explanation,
        proto=proto,
    )


def pose_of(pose: Any) -> types_pb.Pose2D:
    """pose: x_m, y_m, yaw_rad."""
    x_m, y_m, yaw_rad = pose
    return types_pb.Pose2D(x_m=x_m, y_m=y_m, yaw_rad=yaw_rad)


def points_of(points: Any) -> list[types_pb.Point2D]:
    """points: pairs of x_m, y_m."""
    return [types_pb.Point2D(x_m=x_m, y_m=y_m) for x_m, y_m in points]


def word(enum: Any, value: int) -> str:
    """The name of an enum's value without what all names of the enum begin with, in lower case."""
    prefix: str = enum.Name(0).removesuffix("UNSPECIFIED")
    name: str = enum.Name(value).removeprefix(prefix)
    return name.lower()


def _frozen(values: Any) -> npt.NDArray[np.float64]:
    array = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array
