# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""The Python client beside other things: several at a time, left early, and when the server
goes."""

import asyncio
import math
import threading
import unittest

import grpc
import plumescout
import plumescout.aio
import running

POSE = (1.0, 1.0, 0.0)
RANGES_M = [2.0] * 90


def look(robot, time_ns):
    """A cell takes three beams to become free."""
    for i in range(4):
        robot.add_scan(time_ns + i, POSE, RANGES_M, 0.0, math.tau / len(RANGES_M), 8.0)
    robot.add_gas(time_ns + 4, POSE, 5.0)


class AsyncioTest(unittest.IsolatedAsyncioTestCase):
    async def asyncSetUp(self):
        self.server = running.Server()
        self.addCleanup(self.server.stop)
        self.client = plumescout.aio.Client(self.server.target, running.PATIENCE_S)
        self.addAsyncCleanup(self.client.close)
        await self.client.create_mission("hall")

    async def map_with(self, readings):
        async for hall in self.client.watch_map("hall"):
            if hall.status.gas_counters.reading_count == readings:
                return hall

    async def test_robots_send_while_others_watch(self):
        watching = asyncio.create_task(self.map_with(readings=3))
        robots = await asyncio.gather(
            *(self.client.register("hall", f"r{i}", clock_ns=None) for i in range(3))
        )
        for robot in robots:
            look(robot, 1_000)
        await asyncio.gather(*(robot.flush() for robot in robots))
        hall = await watching
        self.assertEqual(hall.occupancy[hall.cell(*POSE[:2])], plumescout.FREE)
        self.assertEqual(len(hall.status.robots), 3)

    async def test_a_watch_that_is_left_is_cancelled_and_the_client_goes_on(self):
        watch = self.client.watch_map("hall")
        self.assertEqual((await watch.__anext__()).status.gas_counters.reading_count, 0)
        await watch.aclose()
        self.assertEqual(await self.client.list_missions(), ["hall"])

    async def test_a_call_that_is_cancelled_ends(self):
        task = asyncio.create_task(self.map_with(readings=-1))
        await self.client.get_mission("hall")
        task.cancel()
        with self.assertRaises(asyncio.CancelledError):
            await task

    async def test_errors_have_their_reason(self):
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            await self.client.get_map("attic")
        self.assertEqual(caught.exception.code, grpc.StatusCode.NOT_FOUND)
        self.assertEqual(caught.exception.reason, "MISSION_NOT_FOUND")


class BlockingTest(unittest.TestCase):
    def setUp(self):
        self.server = running.Server()
        self.addCleanup(lambda: self.server.stop())
        self.client = plumescout.Client(self.server.target, running.PATIENCE_S)
        self.addCleanup(self.client.close)
        self.client.create_mission("hall")

    def test_observations_are_added_while_others_are_sent(self):
        robot = self.client.register("hall", "r1", clock_ns=None)

        def sense():
            for time_ns in range(1, 2001):
                robot.add_gas(time_ns, POSE, 5.0)

        sensing = threading.Thread(target=sense)
        sensing.start()
        while sensing.is_alive():
            robot.flush()
        sensing.join()
        robot.flush()
        self.assertEqual(robot.log.applied_sequence, 2000)
        self.assertEqual(robot.rejections, [])

    def test_a_server_that_kept_nothing_is_told_all_again(self):
        robot = self.client.register("hall", "r1", clock_ns=None)
        look(robot, 1_000)
        first = robot.next_best_trajectory(seed=3)
        self.server.stop()
        self.server = running.Server(listen=self.server.target)
        self.client.create_mission("hall")
        with self.assertLogs("plumescout", "WARNING"):
            again = robot.next_best_trajectory(seed=3)
        self.assertEqual(again.poses.tolist(), first.poses.tolist())
        self.assertEqual(robot.log.applied_sequence, 5)

    def test_a_server_that_is_gone_is_waited_for_as_long_as_was_said(self):
        self.server.process.kill()
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            self.client.call(
                plumescout.rpcs.GET_SERVER_INFO,
                plumescout.rpcs.GET_SERVER_INFO.request(),
                timeout_s=0.2,
            )
        self.assertIn(
            caught.exception.code, (grpc.StatusCode.DEADLINE_EXCEEDED, grpc.StatusCode.UNAVAILABLE)
        )


if __name__ == "__main__":
    unittest.main()
