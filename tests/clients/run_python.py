# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the scenario with the Python client: run_python.py [--asyncio] TARGET SCENARIO; see
README.md."""

import asyncio
import inspect
import json
import math
import pathlib
import sys

import plumescout
import plumescout.aio
import reduce

from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import snapshot_service_pb2 as snapshot_pb
from plumescout.v1 import types_pb2 as types_pb

TIMEOUT_S = 60.0
RETRIES = 100  # while a server takes a mission over
RETRY_PAUSE_S = 0.2


async def get(result):
    """What a call of either client comes to."""
    return await result if inspect.isawaitable(result) else result


async def items(stream):
    """The items of a stream of either client."""
    if hasattr(stream, "__aiter__"):
        async for item in stream:
            yield item
        return
    for item in stream:
        yield item


async def first_of(stream):
    async for item in items(stream):
        return item


class Runner:
    """One method for each kind of step."""

    def __init__(self, client, scenario):
        self.client = client
        self.scenario = scenario
        self.sessions = {}
        self.plans = {}

    # The server and its missions.

    async def get_server_info(self):
        info = await get(self.client.server_info())
        return {"features": list(info.features), "max_receive_bytes": info.limits.max_receive_bytes}

    async def drain_server(self):
        await get(self.client.drain_server())

    async def list_missions(self):
        return {"missions": await get(self.client.list_missions())}

    async def create_mission(
        self, mission, options=None, idle_time_to_live_s=None, event_retention="ALL"
    ):
        keep_all_events = event_retention == "ALL"
        return reduce.mission(
            await get(
                self.client.create_mission(
                    mission,
                    options,
                    idle_time_to_live_s=idle_time_to_live_s,
                    keep_all_events=keep_all_events,
                )
            )
        )

    async def get_mission(self, mission):
        return reduce.mission(await get(self.client.get_mission(mission)))

    async def pause_mission(self, mission):
        return reduce.mission(await get(self.client.pause_mission(mission)))

    async def resume_mission(self, mission):
        return reduce.mission(await get(self.client.resume_mission(mission)))

    async def finish_mission(self, mission):
        return reduce.mission(await get(self.client.finish_mission(mission)))

    async def update_mission(self, mission, **changes):
        if "event_retention" in changes:
            changes["keep_all_events"] = changes.pop("event_retention") == "ALL"
        return reduce.mission(await get(self.client.update_mission(mission, **changes)))

    async def change_keep_out_areas(self, mission, added=None, deleted=()):
        changed = self.client.change_keep_out_areas(mission, added, deleted)
        return {"areas": [reduce.area_of(one) for one in await get(changed)]}

    async def delete_mission(self, mission):
        await get(self.client.delete_mission(mission))

    async def export_mission(self, mission, file, format="JOURNAL"):
        start = await get(self.client.export_mission(mission, file, mcap=format == "MCAP"))
        return {"mission": reduce.last_part(start.mission)}

    async def import_mission(self, file, mission):
        return reduce.mission(await get(self.client.import_mission(file, mission)))

    async def get_mission_history(self, mission, kinds):
        values = [
            snapshot_pb.MissionEventKind.Value("MISSION_EVENT_KIND_" + kind) for kind in kinds
        ]
        events = items(self.client.mission_history(mission, values))
        return {"events": [reduce.event(event) async for event in events]}

    async def get_mission_figures(self, mission):
        return reduce.figures((await get(self.client.mission_figures(mission)))[-1])

    # Robots.

    async def register_robot(
        self, session, mission, robot, radius_m, take_over=False, gas_sensors=()
    ):
        sensors = [
            robot_pb.GasSensor(
                id=sensor["id"],
                robot_from_sensor=types_pb.Point2D(x_m=sensor["ahead_m"], y_m=sensor["left_m"]),
                stddev_ppm=sensor["stddev_ppm"],
            )
            for sensor in gas_sensors
        ]
        registered = self.client.register(
            mission, robot, radius_m, take_over, clock_ns=None, gas_sensors=sensors
        )
        self.sessions[session] = await get(registered)
        return {"applied_sequence": self.sessions[session].log.applied_sequence}

    async def stream_observations(self, session, observations):
        return await self._send(session, observations, stream=True)

    async def batch_ingest_observations(self, session, observations):
        return await self._send(session, observations, stream=False)

    async def _send(self, session, observations, stream):
        robot = self.sessions[session]
        rejected_before = len(robot.rejections)
        for observation in observations:
            self._add(robot, observation)
        await get(robot.flush(stream=stream))
        return {
            "applied_sequence": robot.log.applied_sequence,
            "rejected": [one.sequence for one in robot.rejections[rejected_before:]],
        }

    def _add(self, robot, told):
        time_ns, pose = told["time_ns"], told.get("pose")
        if "scan" in told:
            words = {None: math.nan, "none": math.inf}
            ranges_m = [words.get(r, r) for r in self.scenario["ranges_m"][told["scan"]]]
            robot.add_scan(time_ns, pose, ranges_m, **self.scenario["scan"])
        elif "gas_ppm" in told:
            stddev_ppm, sensor = told.get("stddev_ppm", 0.0), told.get("sensor", 0)
            robot.add_gas(time_ns, pose, told["gas_ppm"], stddev_ppm, sensor)
        elif "correction" in told:
            robot.add_correction(time_ns, pose, told["correction"])
        else:
            robot.add_status(time_ns, told["battery_share"])

    async def list_robots(self, mission):
        robots = await get(self.client.robots(mission))
        return {"robots": [reduce.last_part(robot.on_map.robot) for robot in robots]}

    async def get_robot(self, mission, robot):
        return reduce.robot(await get(self.client.get_robot(mission, robot)))

    async def watch_robot(self, session=None, mission=None, robot=None):
        if session:
            notices = self.sessions[session].watch()
        else:
            notices = self.client.watch_robot(mission, robot)
        return reduce.standing(await first_of(notices))

    async def order_home(self, mission, home, robot=None):
        await get(self.client.order_home(mission, robot, home))

    async def release_lease(self, session=None, mission=None, robot=None):
        if session:
            await get(self.sessions[session].release())
        else:
            await get(self.client.release_lease(mission, robot))

    async def remove_robot(self, session=None, mission=None, robot=None):
        if session:
            await get(self.sessions[session].leave())
        else:
            await get(self.client.remove_robot(mission, robot))

    # Plans.

    async def next_best_trajectory(self, session, budget_s, seed, plan=None):
        robot = self.sessions[session]
        found = await get(robot.next_best_trajectory(budget_s=budget_s, seed=seed))
        self.plans[plan] = found
        return reduce.plan(found)

    async def stream_next_best_trajectory(self, session, budget_s, seed, plan=None):
        robot = self.sessions[session]
        async for found in items(robot.stream_trajectories(budget_s=budget_s, seed=seed)):
            self.plans[plan] = found
        return reduce.plan(self.plans[plan])

    async def check_trajectory(self, session, plan=None, path=None, goal_kind=""):
        robot = self.sessions[session]
        checked = robot.check(self.plans[plan]) if plan else robot.check_path(path, goal_kind)
        return reduce.check(await get(checked))

    async def list_frontiers(self, session):
        found = await get(self.sessions[session].list_frontiers())
        return {"frontiers": [reduce.frontier(frontier) for frontier in found]}

    async def report_progress(self, session, plan, outcome):
        await get(self.sessions[session].report(self.plans[plan], outcome.lower()))

    async def list_plans(self, mission):
        plans = await get(self.client.live_plans(mission))
        return {"plans": [reduce.live_plan(plan) for plan in plans]}

    async def plan_team(self, mission, robots, seed, budget_s, max_order_count):
        team = self.client.plan_team(
            mission, robots, budget_s=budget_s, max_orders=max_order_count, seed=seed
        )
        return reduce.team(await get(team))

    # Maps.

    async def get_map(self, mission, layers=(), **arguments):
        words = [layer.lower().replace("_", "-") for layer in layers]
        return reduce.area(
            await get(self.client.get_map(mission, layers=words, **arguments)), words
        )

    async def watch_map(self, mission, layers=(), during=None):
        words = [layer.lower().replace("_", "-") for layer in layers]
        awaited = None
        async for found in items(self.client.watch_map(mission, layers=words)):
            if during is not None and awaited is None:
                awaited = (await self.stream_observations(**during))["applied_sequence"]
                name = self.sessions[during["session"]].name
            applied = {robot.robot: robot.applied_sequence for robot in found.status.robots}
            if awaited is None or applied[name] >= awaited:
                return reduce.area(found, words)

    async def query_gas(self, mission, points, revision=0):
        of = {"revision": revision}
        mean_ppm, variance_ppm2 = await get(self.client.query_gas(mission, points, **of))
        distance_m, age_s = await get(self.client.nearest_readings(mission, points, **of))
        return {
            "mean_ppm": reduce.numbers(mean_ppm),
            "variance_ppm2": reduce.numbers(variance_ppm2),
            "nearest_reading_m": reduce.numbers(distance_m),
            "nearest_reading_age_s": reduce.numbers(age_s),
        }


async def patiently(step):
    """What a step brings. Streams are not begun again by the client: whoever is told that a server
    takes the mission over does it, as robots do."""
    for _ in range(RETRIES):
        try:
            return await step() or {}
        except plumescout.PlumeScoutError as error:
            if error.reason not in ("RECOVERING", "MISSION_ELSEWHERE"):
                raise
        await asyncio.sleep(RETRY_PAUSE_S)
    return await step() or {}


async def run(client, scenario):
    runner = Runner(client, scenario)
    for step in scenario["steps"]:
        told = {"do": step["do"]}
        try:
            if step["do"] == "restart":
                told["result"] = {}
            else:
                told["result"] = await patiently(
                    lambda: getattr(runner, step["do"])(**step.get("with", {}))
                )
        except plumescout.PlumeScoutError as error:
            told["error"] = {
                "code": error.code.name,
                "reason": error.reason,
                "fields": list(error.fields),
            }
        print(json.dumps(told), flush=True)
        if step["do"] == "restart":
            sys.stdin.readline()


async def main(target, path, is_asyncio):
    scenario = json.loads(pathlib.Path(path).read_text())
    if is_asyncio:
        async with plumescout.aio.Client(target, TIMEOUT_S) as client:
            await run(client, scenario)
    else:
        with plumescout.Client(target, TIMEOUT_S) as client:
            await run(client, scenario)


if __name__ == "__main__":
    asyncio.run(main(*sys.argv[-2:], is_asyncio="--asyncio" in sys.argv))
