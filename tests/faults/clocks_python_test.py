# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""The server's wall clock jumps, by an hour both ways and by a day back, while robots stream: no
lease is lost, no stream breaks, no mission is taken for idle, and the journal is as ever.

libfaketime lies about the wall clock; the monotonic clock goes on, as after settimeofday.
"""

import datetime
import pathlib
import time
import unittest

import answers
import bed
import robots
from plumescout.v1 import mission_service_pb2 as mission_pb

LIBRARY = "/usr/lib/*/faketime/libfaketimeMT.so.1"
JUMPS = ("+3600s", "-3600s", "-86400s", "+0s")
MISSION = "house"
ROBOTS = 3
IDLE_S = 30  # after which nobody has called for the mission


def find_library():
    found = sorted(pathlib.Path("/").glob(LIBRARY.lstrip("/")))
    if not found:
        reason = f"no {LIBRARY}: the package faketime is not installed"
        print(f"\nSKIPPED: {reason}", flush=True)
        raise unittest.SkipTest(reason)
    return str(found[0])


class ClocksTest(unittest.TestCase):
    def test_jumps_harm_nobody(self):
        folder = bed.folder_of(self)
        self.clock = folder / "clock"
        self.clock.write_text("+0s\n")
        server = self.server = bed.Server(
            folder,
            environment={
                "LD_PRELOAD": find_library(),
                "FAKETIME_TIMESTAMP_FILE": str(self.clock),
                "FAKETIME_NO_CACHE": "1",
                "FAKETIME_DONT_FAKE_MONOTONIC": "1",
            },
        ).start()
        self.addCleanup(server.kill)
        told = answers.Answers()
        with robots.Stubs(server.target) as stubs:
            idle = mission_pb.CreateMissionRequest().idle_time_to_live
            idle.FromSeconds(IDLE_S)
            robots.create_mission(stubs, MISSION, told, idle_time_to_live=idle)
        team = [robots.Robot(server.target, MISSION, i, told) for i in range(ROBOTS)]
        for robot in team:
            robot.start()
        try:
            self.await_growth(team)
            for _ in range(bed.size(1, 200)):
                for jump in JUMPS:
                    self.jump(jump, team)
        finally:
            for robot in team:
                robot.stop()
        self.assertTrue(server.alive(), server.log()[-3000:])
        streams = [robot.streams for robot in team]
        server.kill()
        self.assertEqual([breach for robot in team for breach in robot.breaches], [])
        self.assertEqual(streams, [1] * ROBOTS)
        breaches = answers.breaches(answers.read(server.data), told, robots.names(ROBOTS))
        self.assertEqual(breaches, [])
        self.assertEqual(told.count("registered"), ROBOTS)

    def jump(self, jump, team):
        aside = self.clock.with_suffix(".new")
        aside.write_text(f"{jump}\n")
        aside.replace(self.clock)
        ahead_s = float(jump.rstrip("s"))
        has_jumped = lambda: abs(self.time_of_log() - time.time() - ahead_s) < 60.0
        bed.running.await_that(has_jumped, f"the server's clock is at {jump}")
        for _ in range(3):
            time.sleep(0.2)
            self.await_growth(team)

    def time_of_log(self):
        last = self.server.log().splitlines()[-1]
        return datetime.datetime.fromisoformat(last.split()[0]).timestamp()

    def await_growth(self, team):
        before = [robot.durable for robot in team]
        plans = [robot.plans for robot in team]
        bed.running.await_that(
            lambda: all(r.durable > was for r, was in zip(team, before))
            and all(r.plans > was for r, was in zip(team, plans)),
            "every robot's observations become durable, and each gets a plan",
        )


if __name__ == "__main__":
    bed.main()
