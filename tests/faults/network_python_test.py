# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""plumescout-robot behind a bad network: cut, half open, slow, a byte at a time. In the end the
server has the observations, and the map, of a robot that nobody disturbed."""

import json
import math
import subprocess
import threading
import time
import unittest

import numpy as np

import answers
import bed
import fault_proxy
import plumescout
import robots
import room

ROBOT_S = 24.0  # of the robot's clock, that runs so much faster than ours:
PACE = 2.0
TICK_S = 0.05
OUTAGES = {"ci": 2, "long": 100}
OUTAGE_S = (0.5, 2.0)
RESUME_S = 2.0  # after an outage
MISSION = "house"
ROBOT = "scout"


def lines_at(tick):
    """What the robot program says at a tick: its pose, every second time a scan, every tenth gas."""
    time_ns = room.BEGIN_NS + tick * int(TICK_S * 1e9)
    place = tick // 4 % room.POSES
    x_m, y_m, yaw_rad = room.pose_of(0, place)
    pose = {"x_m": x_m, "y_m": y_m, "yaw_rad": yaw_rad}
    yield {"type": "pose", "time_ns": time_ns, **pose}
    if tick % 2 == 0:
        counts = np.frombuffer(room.counts_of(0, place), "<u2")
        yield {
            "type": "scan",
            "time_ns": time_ns,
            "start_angle_rad": 0.0,
            "angle_step_rad": 2 * math.pi / room.BEAMS,
            "max_range_m": room.MAX_RANGE_M,
            "ranges_m": [round(float(count) * room.UNIT_M, 2) for count in counts],
            "pose": pose,
        }
    if tick % 10 == 0:
        ppm = 5.0 + math.sin(tick / 50.0)
        yield {"type": "gas", "time_ns": time_ns, "concentration_ppm": ppm, "pose": pose}


class RobotProgram:
    """plumescout-robot, and a robot that goes its own way at the other end of its pipes."""

    def __init__(self, target, robot_s):
        self.process = subprocess.Popen(
            [
                bed.BUILD_DIR / "bin/plumescout-robot",
                *("--server", target, "--mission", MISSION, "--robot", ROBOT),
                *("--create-mission", "--time-limit", str(robot_s)),
            ],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.said = []
        self._listener = threading.Thread(target=lambda: self.said.extend(self.process.stderr))
        self._talker = threading.Thread(target=self._talk)
        self._listener.start()
        self._talker.start()

    def _talk(self):
        began, tick = time.monotonic(), 0
        try:
            while self.process.poll() is None:
                for line in lines_at(tick):
                    self.process.stdin.write(json.dumps(line) + "\n")
                self.process.stdin.flush()
                tick += 1
                time.sleep(max(0.0, began + tick * TICK_S / PACE - time.monotonic()))
        except OSError:
            pass  # it has ended

    def wait(self):
        code = self.process.wait(timeout=10 * bed.PATIENCE_S)
        self._talker.join()
        self._listener.join()
        try:
            self.process.stdin.close()
        except OSError:
            pass
        return code


class NetworkTest(unittest.TestCase):
    def setUp(self):
        self.folder = bed.folder_of(self)

    def test_the_map_is_that_of_an_undisturbed_run(self):
        faults = {
            "undisturbed": {},
            "delay of 0.3 s": {"delay_s": 0.3},
            "a byte at a time": {"slice_bytes": 1},
            "cut": {"outage": "cut"},
            "half open": {"outage": "half_open"},
        }
        work = lambda name: self.run_robot(name, **faults[name])
        runs = dict(zip(faults, bed.two_at_a_time(work, faults)))
        straight_journal, straight_map = runs.pop("undisturbed")
        straight = straight_journal[MISSION].observations[ROBOT]
        self.assertGreater(len(straight), 10 * ROBOT_S)
        for name, (journal, drawn) in runs.items():
            with self.subTest(name):
                self.assertTrue(journal[MISSION].numbers_in_order)
                self.assertEqual(journal[MISSION].observations[ROBOT], straight)
                np.testing.assert_array_equal(drawn.occupancy, straight_map.occupancy)
                np.testing.assert_allclose(
                    drawn.gas_mean_ppm, straight_map.gas_mean_ppm, rtol=1e-3, atol=1e-3
                )

    def run_robot(self, name, outage=None, **network):
        """({mission: Journal}, Map) of the server in the end."""
        server = bed.Server(bed.folder_of(self, self.folder)).start()
        proxy = fault_proxy.Proxy(server.target, **network)
        try:
            outages = bed.size(OUTAGES["ci"], OUTAGES["long"]) if outage else 0
            robot_s = bed.size(ROBOT_S, ROBOT_S * 20)
            program = RobotProgram(proxy.target, robot_s)
            if outages:
                self.disturb(server, proxy, outage, outages, robot_s / PACE)
            code = program.wait()
            self.assertEqual(code, 0, f"{name}: {''.join(program.said[-20:])}")
            with plumescout.Client(server.target) as client:
                drawn = client.get_map(MISSION)
        finally:
            proxy.stop()
            server.stop()
        return answers.read(server.data), drawn

    def disturb(self, server, proxy, outage, outages, wall_s):
        chance = bed.random_of(outage)
        for number in range(outages):
            time.sleep(wall_s / (outages + 1) - OUTAGE_S[1])
            proxy.set_state(outage)
            time.sleep(chance.uniform(*OUTAGE_S))
            before = self.applied(server)
            proxy.set_state("up")
            began = time.monotonic()
            bed.running.await_that(
                lambda: self.applied(server) > before, f"{outage}: it resumes", RESUME_S
            )
            resumed_s = time.monotonic() - began
            print(f"\n{outage} {number}: resumed after {resumed_s:.2f} s", flush=True)

    def applied(self, server):
        with plumescout.Client(server.target) as client:
            return client.get_robot(MISSION, ROBOT).on_map.applied_sequence


if __name__ == "__main__":
    bed.main()
