# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Robots of ROS 2 by another vendor's DDS (Fast DDS), plumescout-ros2 and a server, on loopback: in a network
namespace of their own if the machine allows it."""

import json
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import unittest

import plumescout
import running

BIN = running.BUILD_DIR / "bin"
PATIENCE_S = 150.0  # far beyond what anything takes here, on any machine
CYCLONE = f"file://{running.ROOT}/tests/ros2_peer/loopback.xml"


class Peer:
    """A simulated robot, with what it last said of itself."""

    def __init__(self, domain, *arguments):
        self.process = subprocess.Popen(
            [BIN / "plumescout-ros2-peer", "--domain", str(domain), "--namespace", "r1", *arguments],
            stdout=subprocess.PIPE,
            text=True,
        )
        self.last = {}
        self.reader = threading.Thread(target=self.read)
        self.reader.start()

    def read(self):
        for line in self.process.stdout:
            self.last = json.loads(line)

    def stop(self):
        self.process.terminate()
        self.process.wait(timeout=running.PATIENCE_S)
        self.reader.join()
        self.process.stdout.close()


class Ros2Test(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.log_file = pathlib.Path(folder.name) / "log"
        self.server = running.Server()
        self.addCleanup(self.server.stop)
        self.domain = 20 + os.getpid() % 80  # where no other test is

    def start_peer(self, *arguments):
        peer = Peer(self.domain, *arguments)
        self.addCleanup(peer.stop)
        return peer

    def start_bridge(self, *arguments):
        command = [BIN / "plumescout-ros2", *arguments]
        command += ["--domain", str(self.domain), "--namespace", "r1"]
        with open(self.log_file, "w") as log:
            bridge = subprocess.Popen(
                command, stderr=log, env=dict(os.environ, CYCLONEDDS_URI=CYCLONE)
            )
        self.addCleanup(self.end, bridge)
        self.bridge = bridge
        return bridge

    def run_mission(self, *arguments):
        mission = ["--server", self.server.target, "--mission", "hall", "--robot", "scout"]
        mission += ["--create-mission", "--max-speed", "0.5", "--map-period", "0.5"]
        return self.start_bridge("run", *mission, *arguments)

    @staticmethod
    def end(bridge):
        if bridge.poll() is None:
            bridge.send_signal(signal.SIGTERM)
        return bridge.wait(timeout=running.PATIENCE_S)

    def log(self):
        return self.log_file.read_text()

    def await_that(self, condition, what):
        def holds():
            if condition():
                return True
            if self.bridge.poll() is not None:
                raise AssertionError(f"plumescout-ros2 has ended before: {what}")
            return False

        try:
            running.await_that(holds, what, PATIENCE_S)
        except AssertionError as error:
            raise AssertionError(f"{error}; the log says:\n{self.log()}") from error

    def assert_mapped(self):
        """The server holds what scanner and gas sensor have said."""
        with plumescout.Client(self.server.target) as client:
            hall = client.get_map("hall")
        free_m2 = (hall.occupancy == plumescout.FREE).sum() * hall.resolution_m**2
        self.assertGreater(free_m2, 3.0)
        self.assertGreater(hall.status.gas_counters.reading_count, 5)
        self.assertEqual(hall.status.robots[0].rejected_observation_count, 0)

    def test_robot_is_driven_and_what_makes_no_sense_is_named(self):
        peer = self.start_peer("--mischief", "--slam-jump", "6")
        bridge = self.run_mission()
        self.await_that(
            lambda: peer.last.get("driven_m", 0.0) > 1.0
            and peer.last["paths"] >= 2
            and peer.last["maps"] > 0
            and peer.last["gas_maps"] > 0
            and peer.last["gas_layers"] > 1
            and peer.last["frontiers"] > 0,
            "the robot has driven a plan and has heard of maps",
        )
        for named in [
            "scan: angle_min is nan",
            "scan: time runs backwards",
            "gas: raw_units is AMP",
            "gas: transforms form a loop",
            "LaserScan: a text is longer than the message",
            "/tf: transform map → ghost is not finite",
            "/r1/tf_static: a publisher is incompatible in durability; have it publish TRANSIENT_LOCAL",
        ]:
            self.await_that(lambda: named in self.log(), named)
        self.assert_mapped()
        self.assertEqual(self.end(bridge), 0)
        log = self.log()
        self.assertRegex(log, r"heard [1-9]\d* scans, [1-9]\d* gas readings")
        self.assertRegex(log, r"refused [1-9]")
        self.assertRegex(log, r"without a place [1-9]")
        self.assertIn("SLAM moved its frame 1 times", log)
        self.assertNotRegex(log, r"observation \d+ refused")
        self.assertEqual(peer.last["unreadable"], 0)

    def test_robot_that_follows_paths_itself_arrives(self):
        peer = self.start_peer("--by-path")
        bridge = self.run_mission("--drive-by", "path")
        self.await_that(lambda: "reached" in self.log(), "a plan was driven to its end")
        self.assertGreater(peer.last["driven_m"], 0.3)
        self.assertEqual(peer.last["velocities"], 0)
        self.assert_mapped()
        self.assertEqual(self.end(bridge), 0)

    def test_check_ends_once_all_is_there(self):
        bridge = self.start_bridge("check", "--for", str(PATIENCE_S))
        self.await_that(
            lambda: "waiting: nobody publishes /r1/scan" in self.log(), "what is missing is named"
        )
        self.start_peer()
        self.assertEqual(bridge.wait(timeout=PATIENCE_S), 0)


if __name__ == "__main__":
    running.enter_network_of_its_own()
    unittest.main()
