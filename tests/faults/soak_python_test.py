# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Missions are made, worked in by eight robots, and ended, again and again: memory and descriptors
do not grow."""

import time
import unittest

import numpy as np

import answers
import bed
import robots
from plumescout.v1 import mission_service_pb2 as mission_pb

DURATION_S = {"ci": 60.0, "long": 7200.0}
WARM_UP = 0.4  # share of the duration
MISSION_S = 2.0
ROBOTS = 8
# A minute says little about an hour: what grows with missions shows in it nevertheless.
GROWTH_BYTES = 12 << 20
SLOPE_BYTES_PER_H = 1 << 20
DESCRIPTORS = 8  # connections that end a little later


class SoakTest(unittest.TestCase):
    def test_nothing_grows(self):
        self.server = bed.Server(bed.folder_of(self)).start()
        self.addCleanup(self.server.kill)
        duration_s = bed.size(DURATION_S["ci"], DURATION_S["long"])
        samples, missions, began = [], 0, time.monotonic()
        while time.monotonic() - began < duration_s:
            self.work_in_a_mission(missions)
            missions += 1
            samples.append(
                (
                    time.monotonic() - began,
                    self.server.rss_bytes(),
                    self.server.descriptors(),
                    self.server.threads(),
                    sum(p.stat().st_size for p in self.server.data.rglob("*") if p.is_file()),
                )
            )
        self.judge(np.array([s for s in samples if s[0] > WARM_UP * duration_s]), missions)
        self.assertEqual(self.server.stop(), 0)

    def work_in_a_mission(self, number):
        name = f"mission-{number}"
        told = answers.Answers()
        with robots.Stubs(self.server.target) as stubs:
            robots.create_mission(stubs, name, told)
            team = [robots.Robot(self.server.target, name, i, told) for i in range(ROBOTS)]
            for robot in team:
                robot.start()
            time.sleep(MISSION_S)
            for robot in team:
                robot.stop()
            if number % 2 == 1:
                finish = mission_pb.FinishMissionRequest(name=f"missions/{name}")
                stubs.missions.FinishMission(finish, timeout=robots.CALL_S)
            delete = mission_pb.DeleteMissionRequest(name=f"missions/{name}")
            stubs.missions.DeleteMission(delete, timeout=robots.CALL_S)
        self.assertEqual([breach for robot in team for breach in robot.breaches], [])
        self.assertGreater(min(robot.durable for robot in team), 0)

    def judge(self, samples, missions):
        times_s, rss, descriptors, threads, disk = samples.T
        slope = np.polyfit(times_s, rss, 1)[0] * 3600.0
        third = max(1, len(rss) // 3)
        growth = np.median(rss[-third:]) - np.median(rss[:third])
        print(
            f"\n{missions} missions; after the warm-up RSS {rss[0] / 2**20:.1f} to "
            f"{rss[-1] / 2**20:.1f} MiB, slope {slope / 2**20:.1f} MiB/h; descriptors "
            f"{descriptors.min():.0f} to {descriptors.max():.0f}, threads {threads.min():.0f} to "
            f"{threads.max():.0f}; data {disk.max() / 2**20:.1f} MiB at most"
        )
        self.assertLessEqual(descriptors.max(), descriptors[0] + DESCRIPTORS)
        self.assertLessEqual(threads.max(), threads[0] + DESCRIPTORS)
        if bed.arguments.long:
            self.assertLess(slope, SLOPE_BYTES_PER_H)
        else:
            self.assertLess(growth, GROWTH_BYTES)


if __name__ == "__main__":
    bed.main()
