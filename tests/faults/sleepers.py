# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Missions that sleep, on one server: what each takes of memory, and how long a caller waits that wakes
one. `scripts/cluster sleepers` builds and runs it.

  --missions N   how many
  --events N     observations in each
"""

import argparse
import pathlib
import random
import sys
import tempfile
import time
import urllib.request

import bed
import robots
import room
import running
from cluster_parts import percentile

from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import robot_service_pb2 as robot_pb

ROBOT = "robot-0"
WOKEN = 40


def create(stubs, mission):
    """Once those before it sleep, which leaves room."""
    deadline = time.monotonic() + running.PATIENCE_S
    while True:
        try:
            return robots.create_mission(stubs, mission, options=robots.cheap_options())
        except robots.grpc.RpcError as error:
            if bed.reason_of(error) != "LIMIT_REACHED" or time.monotonic() > deadline:
                raise
        time.sleep(0.02)


def fill(stubs, mission, events):
    """A mission with one robot, which has left after so many observations."""
    create(stubs, mission)
    request = robot_pb.RegisterRobotRequest(
        mission=f"missions/{mission}", robot_id=ROBOT, radius_m=0.2, log_epoch=1
    )
    lease = robots.await_answer(lambda: stubs.robots.RegisterRobot(request, timeout=30))
    batch = ingest_pb.BatchIngestObservationsRequest(
        open=ingest_pb.OpenIngest(
            robot=f"missions/{mission}/robots/{ROBOT}", lease_token=lease.lease_token
        ),
        batch=ingest_pb.ObservationBatch(
            observations=[room.observation(0, n + 1) for n in range(events)]
        ),
    )
    robots.await_answer(lambda: stubs.ingest.BatchIngestObservations(batch, timeout=30))


def sleeping(server):
    with urllib.request.urlopen(f"http://{server.metrics}/metrics", timeout=30) as page:
        lines = page.read().decode().splitlines()
    values = [line.split()[1] for line in lines if line.startswith("plumescout_missions_sleeping ")]
    return int(float(values[0]))


def wake_s(stubs, mission):
    """Until it answers, for a caller that asks again every 5 ms."""
    request = mission_pb.GetMissionRequest(name=f"missions/{mission}")
    began = time.monotonic()
    while True:
        try:
            stubs.missions.GetMission(request, timeout=30)
            return time.monotonic() - began
        except robots.grpc.RpcError as error:
            if not robots.is_passing(error):
                raise
        time.sleep(0.005)


def main():
    parser = argparse.ArgumentParser(prog="scripts/cluster sleepers", description=__doc__)
    parser.add_argument("--missions", type=int, default=2000)
    parser.add_argument("--events", type=int, default=50)
    arguments = parser.parse_args()
    names = [f"mission-{n}" for n in range(arguments.missions)]
    with tempfile.TemporaryDirectory(prefix="plumescout-sleepers-") as folder:
        server = bed.Server(
            pathlib.Path(folder),
            "store.sleep_after_s=1",
            "limits.max_missions=64",
            "limits.memory_budget_bytes=40000000000",
        ).start()
        try:
            with robots.Stubs(server.target) as stubs:
                fill(stubs, "first", arguments.events)
                running.await_that(lambda: sleeping(server) == 1, "the first sleeps")
                before = server.rss_bytes()
                for name in names:
                    fill(stubs, name, arguments.events)
                running.await_that(lambda: sleeping(server) == len(names) + 1, "all sleep", 120)
                each = (server.rss_bytes() - before) / len(names)
                woken = random.Random(1).sample(names, min(WOKEN, len(names)))
                waits = [1e3 * wake_s(stubs, name) for name in woken]
        finally:
            server.kill()
    print(
        f"{len(names)} missions of {arguments.events} observations sleep: {each / 1e3:.1f} kB each; "
        f"to wake one takes {percentile(waits, 0.5):.0f} ms (p50), {max(waits):.0f} ms (max of "
        f"{len(waits)})"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
