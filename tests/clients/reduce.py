# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What a runner prints of what came back; see README.md."""

import hashlib

import numpy as np
from plumescout.plans import plan_of

from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import snapshot_service_pb2 as snapshot_pb
from plumescout.v1 import types_pb2 as types_pb

_LAYERS = ("occupancy", "gas-mean", "gas-variance")


def last_part(name):
    return name.rsplit("/", 1)[-1]


def word(enum, value, prefix):
    return enum.Name(value).removeprefix(prefix)


def state(value):
    return word(types_pb.CellState, value, "CELL_STATE_")


def phase(value):
    return word(types_pb.MissionPhase, value, "MISSION_PHASE_")


def goal_kind(value):
    return word(types_pb.GoalKind, value, "GOAL_KIND_")


def reason(value):
    name = word(planning_pb.RejectedGoal.Reason, value, "REASON_")
    return None if name == "UNSPECIFIED" else name


def mission(message):
    idle = message.idle_time_to_live.ToNanoseconds() / 1e9
    return {
        "mission": last_part(message.name),
        "state": word(mission_pb.MissionState, message.state, "MISSION_STATE_"),
        "phase": phase(message.phase),
        "robot_count": message.robot_count,
        "event_retention": word(
            mission_pb.EventRetention, message.event_retention, "EVENT_RETENTION_"
        ),
        "idle_time_to_live_s": idle if message.HasField("idle_time_to_live") else None,
    }


def plan(found):
    """Of a plumescout.Plan."""
    columns = (found.poses, found.arrival_s, found.dwell_s, found.speed_mps)
    numbers = np.column_stack(columns).astype("<f8")
    return {
        "named": bool(found.name),
        "end": found.end.upper(),
        "phase": found.phase.upper(),
        "goal_kind": found.goal_kind.upper() or None,
        "length_m": found.length_m,
        "duration_s": found.duration_s,
        "waypoints": len(found.poses),
        "sha256": hashlib.sha256(numbers.tobytes()).hexdigest(),
    }


def check(message):
    rejected = message.rejected_goal.reason if message.HasField("rejected_goal") else 0
    return {
        "blocked": state(message.blockage.state) if message.HasField("blockage") else None,
        "rejected": reason(rejected),
        "length_m": message.rest.length_m if message.HasField("rest") else None,
    }


def frontier(message):
    return {
        "kind": goal_kind(message.goal.kind),
        "reason": reason(message.reason),
        "travel_m": message.travel_m if message.HasField("travel_m") else None,
        "x_m": message.goal.position.x_m,
        "y_m": message.goal.position.y_m,
        "cells": message.goal.frontier_cell_count,
    }


def live_plan(message):
    return {
        "robot": last_part(message.robot),
        "goal_kind": goal_kind(message.goal_kind),
        "x_m": message.goal.x_m,
        "y_m": message.goal.y_m,
        "waypoints": len(message.trajectory.waypoints),
    }


def team(message):
    return {
        "plans": [{"robot": last_part(one.robot), **plan(plan_of(one))} for one in message.plans],
        "left_out": [last_part(one.robot) for one in message.left_out],
    }


def robot(message):
    seen = message.on_map
    pose = [seen.pose.x_m, seen.pose.y_m, seen.pose.yaw_rad]
    return {
        "robot": last_part(seen.robot),
        "leased": message.leased,
        "applied_sequence": seen.applied_sequence,
        "rejected_count": seen.rejected_observation_count,
        "battery_share": message.battery_share if message.HasField("battery_share") else None,
        "ordered_home": message.ordered_home,
        "live_plan": bool(message.live_plan),
        "pose": pose if seen.HasField("pose") else None,
    }


def standing(notice):
    flags = notice.standing.DESCRIPTOR.fields_by_name
    return {"standing": [name for name in flags if getattr(notice.standing, name)]}


def event(message):
    return {
        "kind": word(snapshot_pb.MissionEventKind, message.kind, "MISSION_EVENT_KIND_"),
        "robot": last_part(message.robot) or None,
    }


def figures(message):
    return {
        "known_area_m2": message.known_area_m2,
        "readings": [gas.in_posterior_count for gas in message.gases],
        "robots": [last_part(one.robot) for one in message.robots],
    }


def area(found, layers):
    """Of a plumescout.Map; layers: those that were asked for, none: all."""
    status = found.status
    result = {
        "rows": found.shape[0],
        "columns": found.shape[1],
        "resolution_m": found.resolution_m,
        "origin": list(found.origin_m),
        "robots": [last_part(one.robot) for one in status.robots],
        "reading_count": status.gas_counters.reading_count,
        "frontier_count": len(status.frontiers),
        "phase": phase(status.phase),
    }
    arrays = (found.occupancy, found.gas_mean_ppm, found.gas_variance_ppm2)
    for layer, cells in zip(_LAYERS, arrays):
        if not layers or layer in layers:
            result[f"{layer.replace('-', '_')}_sha256"] = _digest(cells)
    return result


def area_of(polygon):
    return {"name": polygon.name, "corners": [[p.x_m, p.y_m] for p in polygon.vertices]}


def numbers(values):
    return [None if np.isnan(value) else float(value) for value in values]


def _digest(cells):
    if cells.dtype != np.uint8:
        cells = np.where(np.isnan(cells), np.float32(np.nan), cells).astype("<f4")
    return hashlib.sha256(cells.tobytes()).hexdigest()
