# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What a node takes to recover the missions of another one: robots map a building on a server that shares
a store, it is killed, and starts again with one, two and four threads for recoveries, called for all of
its missions at once. `scripts/cluster recovery` builds and runs it.

  --missions N     how many
  --robots N       in each
  --duration S     simulated time of each
  --cores N        that the server has
"""

import argparse
import concurrent.futures
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import bed
import postgres
import robots
import running
from cluster_parts import cpu_s

from plumescout.v1 import mission_service_pb2 as mission_pb

THREADS = (1, 2, 4)
ROUNDS = 2


def server_of(folder, database, threads):
    return bed.Server(
        folder,
        "store.node=n1",
        "store.lease_s=1",
        f"store.recovery_threads={threads}",
        "limits.memory_budget_bytes=17179869184",
        store=database.url_by(f"127.0.0.1:{database.port}"),
    ).start()


def fill(server, names, arguments, folder):
    for number, name in enumerate(names, 1):
        command = [running.BUILD_DIR / "bin/plumescout-lab", "robot", "--scene", arguments.scene]
        command += ["--server", server.target, "--mission", name, "--robots", arguments.robots]
        command += ["--seed", number, "--duration", arguments.duration, "--out", folder / name]
        subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL)


def recover(server, names, cores):
    """Seconds until each mission answers, in order, and the CPU that was spent."""
    os.sched_setaffinity(server.process.pid, range(cores))
    before, began = cpu_s(server.process.pid), time.monotonic()

    def wait(name):
        request = mission_pb.GetMissionRequest(name=f"missions/{name}")
        robots.await_answer(lambda: stubs.missions.GetMission(request, timeout=30))
        return time.monotonic() - began

    with robots.Stubs(server.target) as stubs, concurrent.futures.ThreadPoolExecutor(16) as pool:
        waits_s = sorted(pool.map(wait, names))
    return waits_s, cpu_s(server.process.pid) - before


def main():
    parser = argparse.ArgumentParser(
        prog="scripts/cluster recovery",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--scene", required=True, help=argparse.SUPPRESS)
    for name, standard in (("missions", 8), ("robots", 4), ("cores", os.cpu_count())):
        parser.add_argument(f"--{name}", type=int, default=standard)
    parser.add_argument("--duration", type=float, default=20)
    arguments = parser.parse_args()
    names = [f"mission-{n}" for n in range(arguments.missions)]
    with tempfile.TemporaryDirectory(prefix="plumescout-recovery-") as name:
        folder = pathlib.Path(name)
        folder.chmod(0o755)  # PostgreSQL is another user
        database = postgres.Postgres(folder / "postgres", running.free_port())
        running.await_that(database.make_database, "PostgreSQL answers")
        server = server_of(folder, database, THREADS[0])
        try:
            fill(server, names, arguments, folder)
            for threads in THREADS * ROUNDS:
                server.kill()
                server = server_of(folder, database, threads)
                waits_s, spent_s = recover(server, names, arguments.cores)
                print(
                    f"{threads} at a time: the first mission after {waits_s[0]:.2f} s, half of them after "
                    f"{waits_s[len(waits_s) // 2]:.2f} s, the last after {waits_s[-1]:.2f} s; "
                    f"{spent_s:.2f} s of CPU",
                    flush=True,
                )
            query = "SELECT count(*) FROM plumescout_record r WHERE r.number > coalesce((SELECT "
            query += "max(revision) FROM plumescout_snapshot s WHERE s.mission = r.mission), 0)"
            print(f"{database.ask(query)[0][0]} events behind the snapshots of {len(names)} missions")
        finally:
            server.kill()
            database.stop()
    return 0


if __name__ == "__main__":
    sys.exit(main())
