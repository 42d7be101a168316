# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the scenario with the Python client: run_python.py TARGET SCENARIO; see README.md."""

import json
import pathlib
import sys
import threading

import numpy as np
import plumescout_client
import reduce
from plumescout_client.values import _map_from_proto, _points, _pose, _decode_tile
from google.protobuf import json_format

from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import map_service_pb2 as map_pb
from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import options_pb2 as options_pb
from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import snapshot_service_pb2 as snapshot_pb
from plumescout.v1 import types_pb2 as types_pb
import grpc
from google.rpc import error_details_pb2, status_pb2
import zlib


class Runner:
    def __init__(self, client, scenario):
        self.client = client
        self.scenario = scenario
        self.sessions = {}
        self.plans = {}

    # Missions.
    def get_server_info(self):
        info = self.client.server_info()
        return {
            "features": list(info.features),
            "max_receive_bytes": info.limits.max_receive_bytes,
        }

    def drain_server(self):
        self.client.drain_server()

    def list_missions(self):
        return {"missions": self.client.list_missions()}

    def create_mission(self, mission, options=None, idle_time_to_live_s=None, event_retention="ALL"):
        request = mission_pb.CreateMissionRequest(
            mission_id=mission,
            options=json_format.ParseDict(options or {}, options_pb.MissionOptions()),
            event_retention=mission_pb.EventRetention.Value("EVENT_RETENTION_" + event_retention),
        )
        if idle_time_to_live_s is not None:
            request.idle_time_to_live.FromSeconds(idle_time_to_live_s)
        return reduce.mission(
            self.client._call_named(self.client._missions.CreateMission, request).mission
        )

    def get_mission(self, mission):
        return reduce.mission(self.client.get_mission(mission))

    def pause_mission(self, mission):
        return reduce.mission(self.client.pause_mission(mission))

    def resume_mission(self, mission):
        return reduce.mission(self.client.resume_mission(mission))

    def finish_mission(self, mission):
        return reduce.mission(self.client.finish_mission(mission))

    def update_mission(self, mission, **changes):
        if "idle_time_to_live_s" in changes:
            changed = self.client.set_idle_time_to_live(mission, changes["idle_time_to_live_s"])
        if "event_retention" in changes:
            keep_all = changes["event_retention"] == "ALL"
            changed = self.client.set_keep_all_events(mission, keep_all)
        return reduce.mission(changed)

    def delete_mission(self, mission):
        self.client.delete_mission(mission)

    # Robots.
    def register_robot(self, session, mission, robot, radius_m, take_over=False, gas_sensors=()):
        sensors = [
            robot_pb.GasSensor(
                id=s["id"],
                robot_from_sensor=types_pb.Point2D(x_m=s["ahead_m"], y_m=s["left_m"]),
                stddev_ppm=s["stddev_ppm"],
            )
            for s in gas_sensors
        ]
        self.sessions[session] = self.client.register(
            mission, robot, radius_m, take_over, clock_ns=None, gas_sensors=sensors
        )
        return {"applied_sequence": self.sessions[session].applied_sequence}

    def batch_ingest_observations(self, session, observations):
        robot = self.sessions[session]
        before = len(robot.rejections)
        for one in observations:
            self._add(robot, one)
        robot.flush()
        return {
            "applied_sequence": robot.applied_sequence,
            "rejected": [r.sequence for r in robot.rejections[before:]],
        }

    stream_observations = batch_ingest_observations

    def _add(self, robot, one):
        time_ns, pose = one["time_ns"], one.get("pose")
        if "scan" in one:
            ranges_m = [
                np.nan if r is None else np.inf if r == "none" else r
                for r in self.scenario["ranges_m"][one["scan"]]
            ]
            robot.add_scan(time_ns, pose, ranges_m, **self.scenario["scan"])
        elif "gas_ppm" in one:
            robot.add_gas(
                time_ns, pose, one["gas_ppm"], one.get("stddev_ppm", 0.0), one.get("sensor", 0)
            )
        elif "correction" in one:
            robot.add_correction(time_ns, pose, one["correction"])
        else:
            robot.add_status(time_ns, one["battery_share"])

    def list_robots(self, mission):
        robots = self.client.robots(mission)
        return {"robots": [reduce.last_part(one.on_map.robot) for one in robots]}

    def get_robot(self, mission, robot):
        return reduce.robot(self.client.get_robot(mission, robot))

    def watch_robot(self, session=None, mission=None, robot=None):
        if session:
            notices = self.sessions[session].watch()
        else:
            notices = self.client.watch_robot(mission, robot)
        return reduce.standing(next(notices))

    def order_home(self, mission, home, robot=None):
        self.client.order_home(mission, robot, home)

    def release_lease(self, session=None, mission=None, robot=None):
        if session:
            self.sessions[session].release()
        else:
            self.client.release_lease(mission, robot)

    def remove_robot(self, session=None, mission=None, robot=None):
        if session:
            self.sessions[session].leave()
        else:
            self.client.remove_robot(mission, robot)

    # Plans.
    def next_best_trajectory(self, session, budget_s, seed, plan=None):
        found = self.sessions[session].next_best_trajectory(
            budget_s=budget_s, seed=seed, timeout_s=60
        )
        self.plans[plan] = found
        return reduce.plan(found.proto)

    def stream_next_best_trajectory(self, session, budget_s, seed, plan=None):
        *_, found = self.sessions[session].stream_trajectories(
            budget_s=budget_s, seed=seed, timeout_s=60
        )
        self.plans[plan] = found
        return reduce.plan(found.proto)

    def check_trajectory(self, session, plan=None, path=None, goal_kind=None):
        robot = self.sessions[session]
        if plan:
            return reduce.check(robot.check(self.plans[plan]))
        request = planning_pb.CheckTrajectoryRequest(
            robot=robot._open.robot,
            lease_token=robot._open.lease_token,
            path=planning_pb.IntendedPath(
                vertices=_points(path),
                goal_kind=types_pb.GoalKind.Value("GOAL_KIND_" + goal_kind),
            ),
        )
        return reduce.check(self.client._call(self.client._planning.CheckTrajectory, request))

    def list_frontiers(self, session):
        found = self.sessions[session].list_frontiers()
        return {"frontiers": [reduce.frontier(one) for one in found]}

    def report_progress(self, session, plan, outcome):
        self.sessions[session].report(self.plans[plan], outcome.lower())

    def list_plans(self, mission):
        return {"plans": [reduce.live_plan(one) for one in self.client.live_plans(mission)]}

    def plan_team(self, mission, robots, seed, budget_s, max_order_count):
        return reduce.team(
            self.client.plan_team(
                mission, robots, budget_s=budget_s, max_orders=max_order_count, seed=seed
            )
        )

    # Maps.
    def get_map(self, mission, layers=(), full_precision=True, region=None, level_of_detail=0, max_part_bytes=0, revision=0):
        request = map_pb.GetMapRequest(
            mission=f"missions/{mission}",
            layers=[map_pb.MapLayer.Value("MAP_LAYER_" + layer) for layer in layers],
            full_precision=full_precision,
            fresh_posterior=True,
            level_of_detail=level_of_detail,
            max_part_bytes=max_part_bytes,
            revision=revision,
        )
        if region:
            request.region.min.CopyFrom(_points([region[:2]])[0])
            request.region.max.CopyFrom(_points([region[2:]])[0])
        parts = [self.client._call(self.client._maps.GetMap, request)]
        while parts[-1].next_part_token:
            request.part_token = parts[-1].next_part_token
            parts.append(self.client._call(self.client._maps.GetMap, request))
        return reduce.area(_map_from_proto(parts), [layer.lower() for layer in layers])

    def watch_map(self, mission, layers=(), during=None):
        request = map_pb.WatchMapRequest(
            mission=f"missions/{mission}",
            layers=[map_pb.MapLayer.Value("MAP_LAYER_" + layer) for layer in layers],
            full_precision=True,
        )
        frames = self.client._maps.WatchMap(request)
        parts = []
        for frame in frames:
            if frame.kind in (map_pb.WatchMapResponse.KIND_FULL, map_pb.WatchMapResponse.KIND_RESET):
                parts = []
            if frame.kind == map_pb.WatchMapResponse.KIND_RESET:
                continue
            parts.append(frame)
            if frame.more_follow:
                continue
            found = _map_from_proto(parts)
            latest = [p for p in parts if p.HasField("status")][-1].status
            found = plumescout_client.Map(found.revision, latest, *[getattr(found, n) for n in ("geometry", "occupancy", "gas_mean_ppm", "gas_variance_ppm2")])
            if during is None or not isinstance(during, dict):
                known = {reduce.last_part(r.robot): r.applied_sequence for r in found.status.robots}
                if during is None or known[robot] >= during:
                    frames.cancel()
                    return reduce.area(found, [layer.lower() for layer in layers])
            else:
                name = during["session"]
                robot = reduce.last_part(self.sessions[name]._open.robot)
                during = self.stream_observations(**during)["applied_sequence"]
        return None

    def query_gas(self, mission, points):
        mean_ppm, variance_ppm2 = self.client.query_gas(mission, points)
        return {"mean_ppm": reduce.numbers(mean_ppm), "variance_ppm2": reduce.numbers(variance_ppm2)}

    # Files.
    def export_mission(self, mission, file):
        start = self.client.export_mission(mission, file)
        return {"mission": reduce.last_part(start.mission)}

    def import_mission(self, file, mission):
        return reduce.mission(self.client.import_mission(file, mission))

    def get_mission_history(self, mission, kinds):
        values = [snapshot_pb.MissionEventKind.Value("MISSION_EVENT_KIND_" + k) for k in kinds]
        events = self.client.mission_history(mission, values)
        return {"events": [reduce.event(one) for one in events]}


def fields_of(error):
    return getattr(error, "fields", [])


def main():
    target, path = sys.argv[1:3]
    scenario = json.loads(pathlib.Path(path).read_text())
    with plumescout_client.Client(target, timeout_s=60) as client:
        runner = Runner(client, scenario)
        for step in scenario["steps"]:
            told = {"do": step["do"]}
            try:
                if step["do"] == "restart":
                    told["result"] = {}
                else:
                    told["result"] = getattr(runner, step["do"])(**step.get("with", {})) or {}
            except plumescout_client.PlumeScoutError as error:
                told["error"] = {
                    "code": error.code.name,
                    "reason": error.reason,
                    "fields": fields_of(error),
                }
            print(json.dumps(told), flush=True)
            if step["do"] == "restart":
                sys.stdin.readline()


if __name__ == "__main__":
    main()
