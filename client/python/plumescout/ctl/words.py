# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Messages of the server, in words."""

import datetime

from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import snapshot_service_pb2 as snapshot_pb
from plumescout.v1 import types_pb2 as types_pb

MISSION_HEADINGS = [
    "MISSION",
    "STATE",
    "PHASE",
    "ROBOTS",
    "REVISION",
    "MEMORY",
    "IDLE TTL",
    "OWNER",
    "SERVER",
]
ROBOT_HEADINGS = [
    "ROBOT",
    "LINK",
    "HEARD",
    "LAG",
    "CLOCK",
    "BATTERY",
    "HOME",
    "PLAN",
    "LATE",
    "APPLIED",
    "REFUSED",
    "POSE",
]
PLAN_HEADINGS = ["PLAN", "ROBOT", "GOAL", "X_M", "Y_M", "ARRIVES"]

_KIND_PREFIX = "MISSION_EVENT_KIND_"
EVENT_KINDS = {  # robot-registered, scan, plan ...
    name.removeprefix(_KIND_PREFIX).lower().replace("_", "-"): value
    for name, value in snapshot_pb.MissionEventKind.items()
    if value != snapshot_pb.MISSION_EVENT_KIND_UNSPECIFIED
}


def last_part(name):
    """missions/hall/robots/r1 is r1."""
    return name.rsplit("/", 1)[-1]


def enum_word(enum, value, prefix):
    return enum.Name(value).removeprefix(prefix).lower().replace("_", " ")


def notice_line(notice):
    """A plumescout.v1.WatchRobotResponse."""
    kind = notice.WhichOneof("notice")
    if kind == "standing":
        fields = notice.standing.DESCRIPTOR.fields_by_name
        told = [name.replace("_", " ") for name in fields if getattr(notice.standing, name)]
        return f"standing: {', '.join(told) or 'nothing to tell'}"
    if kind == "plan_invalidated":
        invalidated = notice.plan_invalidated
        reason = enum_word(robot_pb.PlanInvalidated.Reason, invalidated.reason, "REASON_")
        return f"plan {last_part(invalidated.plan)} does not stand: {reason}: {invalidated.detail}"
    return f"plan {last_part(notice.plan_assigned.plan)} was given to it"


def duration(proto):
    """A google.protobuf.Duration, to the tenth."""
    seconds = proto.ToNanoseconds() / 1e9
    for unit, length in (("d", 86_400), ("h", 3_600), ("min", 60)):
        if seconds >= length:
            return f"{seconds / length:.1f} {unit}"
    return f"{seconds:.1f} s"


def size(byte_count):
    for unit, length in (("GB", 1e9), ("MB", 1e6), ("kB", 1e3)):
        if byte_count >= length:
            return f"{byte_count / length:.1f} {unit}"
    return f"{byte_count} B"


def state(mission):
    return enum_word(mission_pb.MissionState, mission.state, "MISSION_STATE_")


def phase(mission):
    return enum_word(types_pb.MissionPhase, mission.phase, "MISSION_PHASE_")


def idle_time_to_live(mission):
    if not mission.HasField("idle_time_to_live"):
        return "never"
    return duration(mission.idle_time_to_live)


def kept_events(mission):
    return enum_word(mission_pb.EventRetention, mission.event_retention, "EVENT_RETENTION_")


def memory(mission):
    if not mission.HasField("memory"):
        return "-"
    return f"{size(mission.memory.used_bytes)} of {size(mission.memory.budget_bytes)}"


def mission_row(mission):
    return [
        last_part(mission.name),
        state(mission),
        phase(mission),
        mission.robot_count,
        mission.revision,
        memory(mission),
        idle_time_to_live(mission),
        mission.owner,
        ": ".join(filter(None, (mission.node, mission.damage))) or "-",
    ]


def mission_facts(mission):
    timings = mission.gas_timings
    return list(zip(MISSION_HEADINGS, mission_row(mission))) + [
        ("KEEPS EVENTS", kept_events(mission)),
        ("STRATEGY", mission.options.planning.strategy),
        ("OBJECTIVE", mission.objective.explanation or "a complete map"),
        ("GASES", ", ".join(gas.name for gas in mission.options.gas_species) or "one"),
        ("GAS UPDATE P99", f"{1e3 * timings.update.p99_s:.1f} ms of {timings.update.sample_count}"),
        ("STALENESS P99", f"{1e3 * timings.staleness.p99_s:.1f} ms"),
    ]


def _seconds(message, field):
    return f"{getattr(message, field):.1f} s" if message.HasField(field) else "-"


def link(robot):
    return enum_word(robot_pb.RobotLink, robot.link, "ROBOT_LINK_")


def home(robot):
    return "ordered" if robot.ordered_home else "battery" if robot.battery_low else "-"


ROBOT_COLUMNS = """\
columns:
  LINK     streaming; idle: no stream is open; silent: not heard of while others are; gone: nobody
           holds its lease
  HEARD    since its latest batch was applied
  LAG      age of the newest reading or scan of that batch
  CLOCK    by how much the mission's time is ahead of the robot's clock
  HOME     whether it was ordered home, or is sent there for its battery
  PLAN     number of its live plan, and LATE: by how much it is behind that
  APPLIED  observations of its log that were taken, REFUSED ones among them
  POSE     x and y in metres, yaw in radians; doubted: its scans contradict the map, which does not
           take them until the robot corrects its poses
"""


def robot_row(robot):
    seen = robot.on_map
    pose = seen.pose
    place = f"{pose.x_m:.2f} {pose.y_m:.2f} {pose.yaw_rad:.2f}" if seen.HasField("pose") else "-"
    if seen.frame_suspect:
        place += " doubted"
    return [
        last_part(seen.robot),
        link(robot),
        _seconds(robot, "last_heard_age_s"),
        _seconds(robot, "ingest_lag_s"),
        f"{robot.clock_offset_s:+.2f} s" if robot.HasField("clock_offset_s") else "-",
        f"{100 * robot.battery_share:.0f} %" if robot.HasField("battery_share") else "-",
        home(robot),
        last_part(robot.live_plan) or "-",
        f"{robot.lateness_s:.1f} s" if robot.live_plan else "-",
        seen.applied_sequence,
        seen.rejected_observation_count,
        place,
    ]


def robot_facts(robot):
    facts = list(zip(ROBOT_HEADINGS, robot_row(robot)))
    facts.insert(1, ("LEASE", "held" if robot.leased else "free"))
    if robot.live_plan:
        facts.append(("PROGRESS", f"{robot.progress_s:.1f} s of its plan"))
        facts.append(("ARRIVES", instant(robot.arrival_time_ns)))
    if robot.HasField("frame"):
        origin = robot.frame.mission_from_robot
        facts.append(("FRAME", f"{origin.x_m:.2f} {origin.y_m:.2f} {origin.yaw_rad:.2f}"))
    return facts


AREA_HEADINGS = ["AREA", "CORNERS"]


def area_row(area):
    return [area.name, " ".join(f"{p.x_m:g},{p.y_m:g}" for p in area.vertices)]


def plan_row(plan):
    return [
        last_part(plan.name),
        last_part(plan.robot),
        enum_word(types_pb.GoalKind, plan.goal_kind, "GOAL_KIND_"),
        f"{plan.goal.x_m:.2f}",
        f"{plan.goal.y_m:.2f}",
        instant(plan.arrival_time_ns),
    ]


def team_facts(team):
    facts = [(last_part(plan.robot), plan.explanation) for plan in team.plans]
    facts += [(last_part(one.robot), f"left out: {one.reason}") for one in team.left_out]
    return facts or [("robots", "none is free")]


def instant(time_ns):
    """In UTC, which the Z says, to the millisecond."""
    seconds, rest_ns = divmod(time_ns, 1_000_000_000)
    try:
        day = datetime.datetime.fromtimestamp(seconds, datetime.timezone.utc)
        return f"{day:%Y-%m-%d %H:%M:%S}.{rest_ns // 1_000_000:03d}Z"
    except (OverflowError, ValueError):  # a clock that nobody has set
        return f"{time_ns / 1e9:.3f} s"


def event_line(event):
    """When it was: of observations by the robot's own clock, else by the mission's time."""
    time = instant(event.sample_time_ns) if event.HasField("sample_time_ns") else ""
    kind = enum_word(snapshot_pb.MissionEventKind, event.kind, _KIND_PREFIX)
    robot = last_part(event.robot) or "-"
    return f"{event.number:>8}  {time:<24}  {kind:<16}  {robot:<12}  {event.summary}"


def store_words(store):
    """Where missions are kept, and how that goes."""
    if not store.engine:
        return "not told by this server"
    if store.engine == "none":
        return "none: missions are gone when the server ends"
    place = f"{store.engine}, {size(store.stored_bytes)}"
    if store.node:
        place += f", node {store.node} of {store.cluster}"
    if store.unreached_nodes:
        place += f", calls do not reach {' '.join(store.unreached_nodes)}"
    if store.available:
        return place
    return f"{place}, takes nothing now" + (f": {store.trouble}" if store.trouble else "")


def server_facts(info):
    limits = info.limits
    return [
        ("VERSION", info.version),
        ("BOOT ID", info.boot_id),
        ("UPTIME", duration(info.uptime)),
        ("CALLER", f"{info.caller} ({info.caller_role})"),
        ("FEATURES", " ".join(info.features) or "-"),
        ("STORE", store_words(info.store)),
        ("REQUEST", size(limits.max_receive_bytes)),
        ("BATCH", f"{limits.max_batch_observation_count} observations"),
        ("MISSIONS", limits.max_mission_count),
        ("PLAN BUDGET", duration(limits.max_planning_budget)),
        ("SCANS", rate(limits.max_scans_per_s)),
        ("GAS READINGS", rate(limits.max_gas_readings_per_s)),
        ("PLANS", rate(limits.max_plans_per_s)),
        ("CLOCK LEAD", duration(limits.max_clock_lead)),
    ]


def rate(per_s):
    return f"{per_s:g} a second" if per_s > 0 else "any number"
