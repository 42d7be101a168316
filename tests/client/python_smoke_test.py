# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs a short mission in a toy room against the built server, through the Python client."""

import os
import pathlib
import subprocess
import tempfile
import time
import unittest

import grpc
import numpy as np

import plumescout
from plumescout.v1 import robot_service_pb2 as robot_pb

BUILD_DIR = pathlib.Path(os.environ["PLUMESCOUT_BUILD_DIR"])
ROOM_M = (6.0, 4.0)  # x and y from 0 to here
START = (1.0, 1.0, 0.0)
SOURCE_M = np.array([4.5, 3.0])
BEAMS = 180
SCANS_A_STOP = 4  # a cell takes three beams to become free
SCAN_PERIOD_NS = 100_000_000
MAX_PLANS = 12


def ranges_in_room(pose):
    """Distance to the walls of the room along each beam."""
    x_m, y_m, yaw_rad = pose
    angles = yaw_rad + np.arange(BEAMS) * 2 * np.pi / BEAMS
    with np.errstate(divide="ignore"):
        to_x = np.where(np.cos(angles) > 0, ROOM_M[0] - x_m, -x_m) / np.cos(angles)
        to_y = np.where(np.sin(angles) > 0, ROOM_M[1] - y_m, -y_m) / np.sin(angles)
    return np.minimum(to_x, to_y)


def gas_ppm(pose):
    return 20.0 * np.exp(-np.sum((np.array(pose[:2]) - SOURCE_M) ** 2))


class ToyRobot:
    def __init__(self, robot):
        self.robot = robot
        self.time_ns = 1_000_000_000_000

    def look(self, pose):
        for _ in range(SCANS_A_STOP):
            self.time_ns += SCAN_PERIOD_NS
            self.robot.add_scan(
                self.time_ns, pose, ranges_in_room(pose), 0.0, 2 * np.pi / BEAMS, 8.0
            )
        self.robot.add_gas(self.time_ns, pose, gas_ppm(pose))

    def drive(self, poses):
        for start, end in zip(poses[:-1], poses[1:]):
            steps = max(1, int(np.hypot(*(end - start)[:2]) / 0.2))
            for share in np.linspace(0, 1, steps + 1)[1:]:
                self.look(tuple(start + share * (end - start)))


class SmokeTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = subprocess.Popen(
            [BUILD_DIR / "bin/plumescout-server", "--listen", "127.0.0.1:0", "--store", "none"],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        for line in cls.server.stdout:
            if line.startswith("listening on "):
                cls.target = line.split()[-1]
                return
        raise RuntimeError("the server did not start")

    @classmethod
    def tearDownClass(cls):
        cls.server.terminate()
        cls.server.wait(timeout=30)
        cls.server.stdout.close()

    def setUp(self):
        self.client = plumescout.Client(self.target)
        self.addCleanup(self.client.close)
        for mission in self.client.list_missions():  # of the tests before
            self.client.delete_mission(mission)

    def test_a_short_mission_maps_the_room_and_its_gas(self):
        self.client.create_mission("toy", {"planning": {"speedMps": 0.5}})
        robot = self.client.register("toy", "scout")
        toy = ToyRobot(robot)
        toy.look(START)
        plans = 0
        for _ in range(MAX_PLANS):
            plan = robot.next_best_trajectory()
            if plan.complete:
                break
            plans += 1
            if len(plan.poses) > 1:
                check = robot.check(plan)
                self.assertFalse(check.HasField("blockage") or check.HasField("rejected_goal"))
                toy.drive(plan.poses)
                robot.report(plan)
        robot.next_best_trajectory()  # brings the gas map up to the last reading

        self.assertGreater(plans, 0)
        self.assertEqual(robot.rejections, [])
        room = self.client.get_map("toy")
        free = room.occupancy == plumescout.FREE
        cells_in_room = ROOM_M[0] * ROOM_M[1] / room.resolution_m**2
        self.assertGreater(free.sum(), 0.9 * cells_in_room)
        self.assertTrue(np.isfinite(room.gas_mean_ppm[free]).all())
        self.assertTrue(np.isnan(room.gas_mean_ppm[~free]).all())
        self.assertTrue((room.gas_variance_ppm2[free] > 0).all())
        at_source = room.gas_mean_ppm[room.cell(*SOURCE_M)]
        self.assertGreater(at_source, room.gas_mean_ppm[room.cell(0.5, 0.5)])
        mean_ppm, variance_ppm2 = self.client.query_gas("toy", [SOURCE_M, (-50.0, 0.0)])
        self.assertAlmostEqual(mean_ppm[0], at_source, places=5)
        self.assertGreater(variance_ppm2[0], 0)
        self.assertTrue(np.isnan(mean_ppm[1]))
        self.assertIsInstance(robot.list_frontiers(), list)
        self.assertEqual(room.status.robots[0].applied_sequence, robot.log.last_sequence)

    def test_each_gas_of_a_mission_has_a_map(self):
        gases = [{"name": "methane"}, {"name": "ozone", "background_mean_ppm": 0.05}]
        self.client.create_mission("gases", {"gas_species": gases})
        sensors = [robot_pb.GasSensor(id="pid"), robot_pb.GasSensor(id="ox", species="ozone")]
        robot = self.client.register("gases", "scout", gas_sensors=sensors)
        pose, time_ns = (1.05, 1.05, 0.0), 1_000_000_000_000
        for i in range(SCANS_A_STOP):
            ranges_m = ranges_in_room(pose)
            robot.add_scan(time_ns + i, pose, ranges_m, 0.0, 2 * np.pi / BEAMS, 8.0)
        robot.add_gas(time_ns + 10, pose, 30.0)
        robot.add_gas(time_ns + 11, pose, 1.0, sensor=1)
        robot.flush()
        self.assertEqual(robot.rejections, [])
        methane = self.client.get_map("gases")
        ozone = self.client.get_map("gases", species="ozone")
        there = methane.cell(*pose[:2])
        self.assertGreater(methane.gas_mean_ppm[there], 10.0)
        self.assertLess(ozone.gas_mean_ppm[there], 1.0)
        self.assertGreater(ozone.gas_mean_ppm[there], 0.5)
        mean_ppm, _ = self.client.query_gas("gases", [pose[:2]], species="ozone")
        self.assertAlmostEqual(mean_ppm[0], ozone.gas_mean_ppm[there], places=5)
        counts = [(gas.species, gas.gas_counters.reading_count) for gas in ozone.status.gases]
        self.assertEqual(counts, [("methane", 1), ("ozone", 1)])
        with self.assertRaises(plumescout.PlumeScoutError):
            self.client.get_map("gases", species="xenon")

    def test_a_clock_that_is_an_hour_ahead_is_learnt(self):
        def clock_ns():
            return time.time_ns() + 3_600_000_000_000

        self.client.create_mission("clocks")
        robot = self.client.register("clocks", "scout", clock_ns=clock_ns)
        robot.add_gas(clock_ns(), START, 1.0)
        robot.add_status(clock_ns(), 0.5)
        robot.flush()
        self.assertEqual(robot.rejections, [])
        shown = self.client.get_robot("clocks", "scout")
        self.assertLess(abs(shown.clock_offset_s + 3600), 60)
        self.assertLess(abs(shown.ingest_lag_s), 60)
        self.assertEqual(shown.battery_share, 0.5)
        untold = self.client.register("clocks", "other", clock_ns=None)
        untold.add_gas(1, START, 1.0)
        untold.flush()
        shown = self.client.get_robot("clocks", "other")
        self.assertFalse(shown.HasField("clock_offset_s"))

    def test_a_known_building_is_planned_in_without_a_scan(self):
        cells = np.full((40, 60), plumescout.OCCUPIED)
        cells[1:-1, 1:-1] = plumescout.FREE
        pgm = np.where(cells == plumescout.FREE, 254, 0).astype(np.uint8)[::-1]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "map.yaml")
            path.write_text(
                "image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n"
                "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
            )
            path.with_suffix(".pgm").write_bytes(b"P5 60 40 255\n" + pgm.tobytes())
            files = plumescout.prior_map_of_files(path)
        self.client.create_mission("cells", {"prior_map": plumescout.prior_map(cells, 0.1)})
        self.client.create_mission("files", {"prior_map": files})
        maps = [self.client.get_map(name) for name in ("cells", "files")]
        np.testing.assert_array_equal(maps[0].occupancy, maps[1].occupancy)
        self.assertEqual((maps[0].occupancy == plumescout.FREE).sum(), 38 * 58)

        whole = maps[0]
        coarse = self.client.get_map("cells", level_of_detail=2)
        self.assertEqual(coarse.occupancy[coarse.cell(3.0, 2.0)], plumescout.FREE)
        self.assertEqual(coarse.occupancy[coarse.cell(0.05, 0.05)], plumescout.OCCUPIED)
        self.assertEqual(coarse.resolution_m, 4 * whole.resolution_m)
        corner = self.client.get_map("cells", region=(-1.0, -1.0, 1.0, 1.0))
        row, column = whole.cell(1.0, 1.0)
        np.testing.assert_array_equal(
            corner.occupancy[:row, :column], whole.occupancy[:row, :column]
        )
        nowhere = self.client.get_map("cells", region=(90.0, 90.0, 91.0, 91.0))
        self.assertTrue((nowhere.occupancy == plumescout.UNKNOWN).all())

        robot = self.client.register("files", "scout")
        robot.add_gas(1_000_000_000, START, 8.0)
        plan = robot.next_best_trajectory()
        self.assertGreater(len(plan.poses), 1)
        self.assertEqual(robot.rejections, [])

    def test_the_last_plan_of_a_stream_is_committed(self):
        options = {"planning": {"speedMps": 0.5, "paths": "PATH_KIND_ANYTIME_XIT"}}
        self.client.create_mission("stream", options)
        robot = self.client.register("stream", "scout")
        ToyRobot(robot).look(START)
        plans = list(robot.stream_trajectories(seed=3))
        self.assertEqual([bool(p.proto.name) for p in plans], [False] * (len(plans) - 1) + [True])
        robot.report(plans[-1])

    def test_ranges_survive_the_wire(self):
        self.client.create_mission("ranges")
        robot = self.client.register("ranges", "scout")
        ranges = np.array([np.inf, np.nan, 0.004, 2.0, 400.0, -1.0])
        robot.add_scan(1, START, ranges, 0.0, 1.0, 500.0)
        robot.add_scan(2, START, ranges[:4], 0.0, 1.0, 50.0)
        with self.assertLogs("plumescout", "WARNING"):
            robot.flush()

        self.assertEqual([r.sequence for r in robot.rejections], [1])  # beyond the mission's range
        self.assertIn("max_range_m", robot.rejections[0].message)

    def test_refused_observations_are_logged(self):
        self.client.create_mission("logged")
        robot = self.client.register("logged", "scout")
        robot.add_gas(1, START, 1.0)
        robot.add_gas(2, START, -5.0)
        with self.assertLogs("plumescout", "WARNING") as logs:
            robot.flush()

        self.assertEqual(len(logs.output), 1)
        self.assertIn("missions/logged/robots/scout: observation 2 refused", logs.output[0])
        self.assertIn("concentration_ppm = -5", logs.output[0])
        self.assertEqual([r.sequence for r in robot.rejections], [2])

    def test_refused_observations_reach_the_callback(self):
        self.client.create_mission("told")
        told = []
        robot = self.client.register("told", "scout", on_rejected=told.append)
        robot.add_gas(1, START, -5.0)
        robot.add_gas(2, START, 1.0)
        robot.add_gas(3, START, float("nan"))
        with self.assertNoLogs("plumescout"):
            robot.flush()

        self.assertEqual([r.sequence for r in told], [1, 3])
        self.assertEqual(told, robot.rejections)

    def test_a_callback_that_raises_loses_nothing(self):
        def refuse(rejection):
            raise ValueError(rejection.message)

        self.client.create_mission("raised")
        robot = self.client.register("raised", "scout", on_rejected=refuse)
        robot.add_gas(1, START, -5.0)
        with self.assertRaises(ValueError):
            robot.flush()
        robot.add_gas(2, START, 1.0)
        robot.flush()  # sends the second alone
        self.assertEqual([r.sequence for r in robot.rejections], [1])

    def test_errors_carry_code_and_reason(self):
        self.client.create_mission("errors")
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            self.client.create_mission("errors")
        self.assertEqual(caught.exception.code, grpc.StatusCode.ALREADY_EXISTS)
        self.client.create_mission("errors", exist_ok=True)

        old = self.client.register("errors", "scout")
        self.client.register("errors", "scout", take_over=True)
        old.add_gas(1, START, 1.0)
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            old.flush()
        self.assertEqual(caught.exception.reason, "LEASE_SUPERSEDED")

    def test_missions_are_listed_and_deleted(self):
        self.client.create_mission("listed")
        self.assertIn("listed", self.client.list_missions())
        self.client.delete_mission("listed")
        self.assertNotIn("listed", self.client.list_missions())

    def test_a_robot_goes_on_where_its_log_ends(self):
        self.client.create_mission("return")
        first = self.client.register("return", "scout")
        first.add_gas(1, START, 1.0)
        first.flush()
        second = self.client.register("return", "scout", take_over=True)
        self.assertEqual(second.add_gas(2, START, 1.0), 2)
        second.flush()

    def test_a_robot_leaves_or_is_removed(self):
        self.client.create_mission("leaving")
        robot = self.client.register("leaving", "scout")
        robot.add_gas(1, START, 1.0)
        robot.leave()
        self.assertEqual(len(self.client.get_map("leaving").status.robots), 0)
        back = self.client.register("leaving", "scout")
        self.assertEqual(back.add_gas(2, START, 1.0), 2)
        self.client.remove_robot("leaving", "scout")
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            back.flush()
        self.assertEqual(caught.exception.reason, "ROBOT_NOT_FOUND")


if __name__ == "__main__":
    unittest.main()
