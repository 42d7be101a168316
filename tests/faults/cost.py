# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What an event costs a cluster on this machine: the CPU of servers, router and database while simulated
robots map a building through the router, as fast as it goes. `scripts/cluster cost` builds and runs it.

  --missions N     how many, each begun when the one before has
  --at-once        begun all at once
  --robots N       in each
  --duration S     simulated time of each
  --nodes N        servers, 1 to 3
  --router-share S of a core, that the router gets at most; needs root

Robots are those of `plumescout-lab robot`: ten scans of 360 beams and two readings a second, and plans as
they need them. An event is an entry of a mission's journal. Exit code 1 if a mission ended early.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile
import time

import postgres
import running
from cluster_parts import Node, Router, cpu_s

LEASE_S = 30.0  # the machine is busy, and no mission is to move
PATIENCE_S = 300.0
EVENTS = "SELECT coalesce(sum(head), 0)::bigint, coalesce(sum(writes), 0)::bigint FROM plumescout_progress"


class Cluster:
    def __init__(self, folder, nodes, router_share):
        folder.chmod(0o755)  # PostgreSQL is another user
        self.database = postgres.Postgres(folder / "postgres", running.free_port())
        running.await_that(self.database.make_database, "PostgreSQL answers")
        address, url_by = f"127.0.0.1:{self.database.port}", self.database.url_by
        self._nodes = [
            Node(f"n{i + 1}", folder, url_by, address, cuttable=False, lease_s=LEASE_S)
            for i in range(nodes)
        ]
        self.router = Router(self._nodes, folder)
        running.await_that(self.router.answers, "the router leads to a node")
        if router_share:
            self.router.hold_to(router_share)

    def cpu_s(self):
        return {
            "servers": sum(cpu_s(node.server.process.pid) for node in self._nodes),
            "HAProxy": cpu_s(self.router.process.pid),
            "PostgreSQL": sum(map(cpu_s, self.database.pids())),
        }

    def count(self, query):
        return [int(value) for value in self.database.ask(query)[0]]

    def stop(self):
        self.router.stop()
        for node in self._nodes:
            node.stop()
        self.database.stop()


def start_team(cluster, number, arguments, folder):
    """A mission's robots. Returns their process, once the mission has begun unless all begin at once."""
    command = [running.BUILD_DIR / "bin/plumescout-lab", "robot", "--scene", arguments.scene]
    command += ["--server", cluster.router.target, "--mission", f"mission-{number}"]
    command += ["--robots", arguments.robots, "--seed", number, "--duration", arguments.duration]
    command += ["--out", folder / f"team-{number}"]
    log = folder / f"team-{number}.log"
    with open(log, "wb") as file:
        process = subprocess.Popen(list(map(str, command)), stdout=file, stderr=file)
    if arguments.at_once:
        return process
    begun = lambda: b"simulated" in log.read_bytes() or process.poll() is not None
    running.await_that(begun, "the mission has begun", PATIENCE_S)
    return process


def run(cluster, arguments, folder):
    """Prints what was spent. Returns whether all missions came to their end."""
    before, began = cluster.cpu_s(), time.monotonic()
    missions = range(1, arguments.missions + 1)
    teams, most = [], 0
    for number in missions:
        teams.append(start_team(cluster, number, arguments, folder))
        most = max(most, sum(team.poll() is None for team in teams))
    codes = [team.wait() for team in teams]
    for number, code in zip(missions, codes):
        if code != 0:
            print(f"mission {number}: {(folder / f'team-{number}.log').read_text().splitlines()[-1:]}")
    spent = {part: value - before[part] for part, value in cluster.cpu_s().items()}
    events, writes = cluster.count(EVENTS)
    each = ", ".join(f"{part} {1e6 * value / events:.0f}" for part, value in spent.items())
    share = (spent["HAProxy"] + spent["PostgreSQL"]) / spent["servers"]
    took_s = time.monotonic() - began
    early = sum(code != 0 for code in codes)
    print(
        f"{events} events in {writes} writes and {took_s:.0f} s, at most {most} "
        f"missions at one time, {early} ended early; microseconds of CPU an event: {each}; router and database {share:.1%} of the "
        f"servers; HAProxy took {spent['HAProxy'] / took_s:.3f} cores"
    )
    return early == 0


def main():
    parser = argparse.ArgumentParser(
        prog="scripts/cluster cost",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--scene", required=True, help=argparse.SUPPRESS)
    for name, standard in (("missions", 24), ("robots", 4), ("nodes", 3)):
        parser.add_argument(f"--{name}", type=int, default=standard)
    parser.add_argument("--duration", type=float, default=20)
    parser.add_argument("--router-share", type=float, default=0.0)
    parser.add_argument("--at-once", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="plumescout-cost-") as name:
        folder = pathlib.Path(name)
        cluster = Cluster(folder, arguments.nodes, arguments.router_share)
        try:
            return 0 if run(cluster, arguments, folder) else 1
        finally:
            cluster.stop()


if __name__ == "__main__":
    sys.exit(main())
