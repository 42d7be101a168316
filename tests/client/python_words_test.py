# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What plumescoutctl makes of the server's messages in words."""

import unittest

from plumescout.ctl import words

from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import system_service_pb2 as system_pb


class WordsTest(unittest.TestCase):
    def test_a_robot_that_lost_its_place_is_marked(self):
        robot = robot_pb.Robot()
        robot.on_map.robot = "missions/hall/robots/r1"
        robot.on_map.pose.x_m = 1.5
        row = dict(zip(words.ROBOT_HEADINGS, words.robot_row(robot)))
        self.assertEqual((row["ROBOT"], row["POSE"]), ("r1", "1.50 0.00 0.00"))
        robot.on_map.frame_suspect = True
        row = dict(zip(words.ROBOT_HEADINGS, words.robot_row(robot)))
        self.assertEqual(row["POSE"], "1.50 0.00 0.00 doubted")
        for heading in ("LINK", "HEARD", "LAG", "CLOCK", "PLAN", "LATE", "APPLIED", "REFUSED"):
            self.assertIn(heading, words.ROBOT_COLUMNS)

    def test_a_node_that_calls_do_not_reach_is_named(self):
        store = system_pb.StoreInfo(engine="postgresql", node="n2", cluster="hall", available=True)
        self.assertEqual(words.store_words(store), "postgresql, 0 B, node n2 of hall")
        store.unreached_nodes.extend(["n1", "n3"])
        self.assertTrue(words.store_words(store).endswith(", calls do not reach n1 n3"))

    def test_what_is_wrong_with_a_mission_is_said(self):
        mission = mission_pb.Mission(state=mission_pb.MISSION_STATE_DAMAGED, damage="the header")
        self.assertEqual(words.mission_row(mission)[-1], "the header")
        mission.node = "n1"
        self.assertEqual(words.mission_row(mission)[-1], "n1: the header")

    def test_an_instant_is_a_time_of_day_if_there_is_one(self):
        self.assertEqual(words.instant(1_700_000_000_250_000_000), "2023-11-14 22:13:20.250Z")
        self.assertEqual(words.instant(1 << 62), "2116-02-20 23:53:38.427Z")


if __name__ == "__main__":
    unittest.main()
