# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""The commands: each takes a client, the arguments and a Printer."""

import itertools
import json
import pathlib
import time

import plumescout

from . import top, words
from .output import Progress


def list_missions(client, _, out):
    out.messages(client.missions(), words.MISSION_HEADINGS, words.mission_row)


def show_mission(client, arguments, out):
    mission = client.get_mission(arguments.mission)
    out.message(mission, words.mission_facts(mission))


def create_mission(client, arguments, out):
    options = {}
    if arguments.options is not None:
        options = json.loads(pathlib.Path(arguments.options).read_text())
    if arguments.prior_map is not None:
        options["prior_map"] = plumescout.prior_map_of_files(arguments.prior_map)
    client.create_mission(
        arguments.mission,
        options,
        arguments.exist_ok,
        idle_time_to_live_s=arguments.ttl,
        keep_all_events=arguments.keep == "all",
    )
    show_mission(client, arguments, out)


def _change_mission(method):
    def command(client, arguments, out):
        mission = getattr(client, method)(arguments.mission)
        out.message(mission, words.mission_facts(mission))

    return command


pause_mission = _change_mission("pause_mission")
resume_mission = _change_mission("resume_mission")
finish_mission = _change_mission("finish_mission")


def close_area(client, arguments, out):
    corners = arguments.corners
    if len(corners) == 2:
        (x0_m, y0_m), (x1_m, y1_m) = corners
        corners = [(x0_m, y0_m), (x1_m, y0_m), (x1_m, y1_m), (x0_m, y1_m)]
    areas = client.change_keep_out_areas(arguments.mission, {arguments.area: corners})
    _print_areas(areas, out)


def open_area(client, arguments, out):
    _print_areas(client.change_keep_out_areas(arguments.mission, deleted=[arguments.area]), out)


def _print_areas(areas, out):
    out.messages(areas, words.AREA_HEADINGS, words.area_row)


def delete_mission(client, arguments, out):
    client.delete_mission(arguments.mission)
    out.done(f"deleted {arguments.mission}")


def set_ttl(client, arguments, out):
    mission = client.update_mission(arguments.mission, idle_time_to_live_s=arguments.seconds)
    out.message(mission, words.mission_facts(mission))


def set_keep(client, arguments, out):
    mission = client.update_mission(
        arguments.mission, keep_all_events=arguments.events == "all"
    )
    out.message(mission, words.mission_facts(mission))


def export_mission(client, arguments, out):
    with Progress(f"export of {arguments.mission}") as progress:
        mcap = arguments.mcap or arguments.file.endswith(".mcap")
        start = client.export_mission(arguments.mission, arguments.file, progress, mcap)
    out.done(f"wrote {arguments.file}: {arguments.mission} up to event {start.revision}")


def import_mission(client, arguments, out):
    try:
        with Progress(f"import of {arguments.file}") as progress:
            mission = client.import_mission(arguments.file, arguments.name, progress)
    except plumescout.PlumeScoutError as error:
        error.args = (f"{arguments.file}: {error}",)
        raise
    out.message(mission, words.mission_facts(mission))


def show_history(client, arguments, out):
    kinds = [words.EVENT_KINDS[kind] for kind in arguments.kind or ()]
    events = client.mission_history(arguments.mission, kinds, arguments.first)
    if arguments.count:
        events = itertools.islice(events, arguments.count)
    out.lines(events, words.event_line)


def list_robots(client, arguments, out):
    out.messages(client.robots(arguments.mission), words.ROBOT_HEADINGS, words.robot_row)


def show_robot(client, arguments, out):
    robot = client.get_robot(arguments.mission, arguments.robot)
    out.message(robot, words.robot_facts(robot))


def _order_home(is_home, done):
    def command(client, arguments, out):
        if (arguments.robot is None) != arguments.all:
            raise ValueError("name one ROBOT, or give --all")
        client.order_home(arguments.mission, arguments.robot, is_home)
        out.done(f"{done}: {arguments.robot or 'all robots'} of {arguments.mission}")

    return command


send_home = _order_home(True, "sent home")
cancel_home = _order_home(False, "back to work")


def watch_robot(client, arguments, out):
    notices = client.watch_robot(arguments.mission, arguments.robot)
    if arguments.count:
        notices = itertools.islice(notices, arguments.count)
    out.lines(
        notices, lambda notice: f"{words.instant(time.time_ns())}  {words.notice_line(notice)}"
    )


def remove_robot(client, arguments, out):
    client.remove_robot(arguments.mission, arguments.robot)
    out.done(f"removed {arguments.robot} from {arguments.mission}")


def release_lease(client, arguments, out):
    client.release_lease(arguments.mission, arguments.robot)
    out.done(f"released the lease of {arguments.robot} in {arguments.mission}")


def export_map(client, arguments, out):
    found = client.get_map(
        arguments.mission, revision=arguments.revision, species=arguments.species
    )
    paths = found.save(arguments.file, arguments.layer)
    out.done(f"wrote {' and '.join(str(path) for path in paths)}")


def list_plans(client, arguments, out):
    out.messages(client.live_plans(arguments.mission), words.PLAN_HEADINGS, words.plan_row)


def plan_team(client, arguments, out):
    team = client.plan_team(arguments.mission, arguments.robots, arguments.go_home)
    out.message(team, words.team_facts(team))


def show_server(client, _, out):
    info = client.server_info()
    out.message(info, words.server_facts(info))


def drain_server(client, _, out):
    client.drain_server()
    out.done("the server drains")


def show_top(client, arguments, out):
    top.follow(client, arguments.interval, arguments.count, out.json)
