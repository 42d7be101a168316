# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A small disk becomes full while robots stream: nothing is acknowledged that is not kept, the
server lives and answers what needs no disk, and goes on soon after there is room again.

Needs the right to mount a tmpfs. Without it the test is skipped, and says so.
"""

import os
import subprocess
import time
import unittest

import grpc

import answers
import bed
import robots
from plumescout.v1 import map_service_pb2 as map_pb
from plumescout.v1 import map_service_pb2_grpc as map_grpc
from plumescout.v1 import planning_service_pb2 as planning_pb

MISSION = "house"
ROBOTS = 2
RESUME_S = 5.0  # what is promised
SILENCE_S = 1.5  # without acknowledgements: the disk is full
ROUNDS = {"ci": 2, "long": 50}
# Room for all that the robots make the server write by themselves: else they, not the ballast, fill
# the disk, and nothing goes on when that is gone. The write-ahead log grows to 16 MiB before it is
# taken into the database: each of 66 batches a second changes three pages of 16 KiB. The database
# grows by less than 0.1 MB/s while there is room, one or two seconds a round, and by two snapshots.
DISK_MB = 64


def mount_tmpfs(test, mega_bytes):
    folder = bed.folder_of(test)
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", f"size={mega_bytes}m,mode=0700", "plumescout", folder],
        capture_output=True,
        text=True,
    )
    if mounted.returncode != 0:
        reason = f"no right to mount a tmpfs: {mounted.stderr.strip()}"
        print(f"\nSKIPPED: {reason}", flush=True)
        raise unittest.SkipTest(reason)
    test.addCleanup(subprocess.run, ["umount", "-l", folder], check=True)
    return folder


def fill(path):
    """Takes all the room that there is."""
    with open(path, "ab", buffering=0) as ballast:
        for size in (1 << 16, 1 << 12):
            try:
                while True:
                    ballast.write(bytes(size))
            except OSError:
                pass


class DiskFullTest(unittest.TestCase):
    def setUp(self):
        self.disk = mount_tmpfs(self, DISK_MB)
        self.server = bed.Server(bed.folder_of(self), data=self.disk / "data").start()
        self.addCleanup(self.server.kill)
        self.told = answers.Answers()

    def test_it_lives_and_goes_on(self):
        with robots.Stubs(self.server.target) as self.stubs:
            robots.create_mission(self.stubs, MISSION, self.told)
            team = [robots.Robot(self.server.target, MISSION, i, self.told) for i in range(ROBOTS)]
            for robot in team:
                robot.start()
            try:
                for _ in range(bed.size(ROUNDS["ci"], ROUNDS["long"])):
                    self.fill_and_clear(team)
            finally:
                for robot in team:
                    robot.stop()
        self.server.kill()
        self.assertEqual([breach for robot in team for breach in robot.breaches], [])
        journals = answers.read(bed.copy_of(self.server.data, bed.folder_of(self) / "data"))
        breaches = answers.breaches(journals, self.told, robots.names(ROBOTS))
        self.assertEqual(breaches, [])

    def fill_and_clear(self, team):
        self.await_growth(team, bed.PATIENCE_S)
        ballast = self.disk / "ballast"
        fill(ballast)
        silent = lambda: time.monotonic() - max(r.last_acknowledged_s for r in team) > SILENCE_S
        bed.running.await_that(lambda: fill(ballast) or silent(), "the disk is full")
        held = [robot.durable for robot in team]
        self.check_answers()
        self.assertEqual([robot.durable for robot in team], held)
        os.unlink(ballast)
        began = time.monotonic()
        self.await_growth(team, RESUME_S)
        print(f"\nwent on {time.monotonic() - began:.2f} s after there was room", flush=True)

    def await_growth(self, team, patience_s):
        before = [robot.durable for robot in team]
        bed.running.await_that(
            lambda: all(robot.durable > was for robot, was in zip(team, before)),
            "acknowledgements of every robot",
            patience_s,
        )

    def check_answers(self):
        """Reading goes on; plans are answered, or refused by name."""
        self.assertTrue(self.server.alive())
        maps = map_grpc.MapServiceStub(self.stubs.channel)
        maps.GetMap(map_pb.GetMapRequest(mission=f"missions/{MISSION}"), timeout=robots.CALL_S)
        robot = f"missions/{MISSION}/robots/robot-0"
        frontiers = planning_pb.ListFrontiersRequest(robot=robot)
        self.stubs.planning.ListFrontiers(frontiers, timeout=robots.CALL_S)
        token = self.told.of("registered", MISSION)[-1]
        request = planning_pb.NextBestTrajectoryRequest(
            robot=f"missions/{MISSION}/robots/{token[0]}",
            lease_token=token[1],
            max_edge_evaluation_count=100,
        )
        try:
            self.stubs.planning.NextBestTrajectory(request, timeout=30.0)
        except grpc.RpcError as error:
            self.assertEqual(bed.reason_of(error), "STORE_UNAVAILABLE", error.details())


if __name__ == "__main__":
    bed.main()
