# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What a robot of the Python client keeps, and tells a server that lost or does not take it."""

import itertools
import types
import unittest

import grpc
import plumescout
from plumescout import calls as calls_module

from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import robot_service_pb2 as robot_pb

POSE = (0.0, 0.0, 0.0)


class FakeServer:
    """The log of one robot, as a server holds it."""

    def __init__(self):
        self.log = []  # numbers; a gap's as (first, last)
        self.keeps = True
        self.lag = 0
        self.durable = 0
        self.limits = types.SimpleNamespace(
            max_batch_observation_count=4, max_receive_bytes=1 << 20
        )
        self._ingest = types.SimpleNamespace(BatchIngestObservations=self.take)

    @property
    def applied(self):
        last = self.log[-1] if self.log else 0
        return last[1] if isinstance(last, tuple) else last

    def fall_back_to(self, count):
        self.log = self.log[:count]
        self.durable = self.applied

    def _call(self, method, request, before_try=None):
        if before_try is not None:
            before_try(request)
        return method(request)

    def take(self, request):
        if request.open.durable_sequence > self.applied:
            raise plumescout.PlumeScoutError(
                grpc.StatusCode.FAILED_PRECONDITION,
                "set back",
                "STORE_ROLLED_BACK",
                metadata={"applied_sequence": str(self.applied)},
            )
        for observation in request.batch.observations:
            if observation.sequence > self.applied + 1:
                raise plumescout.PlumeScoutError(
                    grpc.StatusCode.FAILED_PRECONDITION, "a hole", "SEQUENCE_GAP"
                )
            gap = observation.gap if observation.HasField("gap") else None
            self.log.append(
                (gap.first_sequence, gap.last_sequence) if gap else observation.sequence
            )
        if self.keeps:
            self.durable = max(self.durable, self.applied - self.lag)
        response = ingest_pb.BatchIngestObservationsResponse()
        response.ingest_state.applied_sequence = self.applied
        response.ingest_state.durable_sequence = self.durable
        return response


class RobotTest(unittest.TestCase):
    def setUp(self):
        self.server = FakeServer()
        self.robot = plumescout.Robot(
            self.server, robot_pb.RegisterRobotResponse(robot="missions/m/robots/r")
        )

    def send(self, count):
        for _ in range(count):
            self.robot.add_gas(1, POSE, 1.0)
        self.robot.flush()

    def test_what_is_durable_is_forgotten(self):
        self.server.lag = 3
        self.send(10)
        self.assertEqual(self.server.log, list(range(1, 11)))
        self.assertEqual(self.robot.durable_sequence, 7)
        self.assertEqual([o.sequence for o in self.robot._kept], [8, 9, 10])

    def test_a_server_that_keeps_nothing_needs_nothing_kept(self):
        self.server.keeps = False
        self.send(10)
        self.assertEqual(self.robot._kept, [])

    def test_what_was_not_durable_is_told_again_after_a_crash(self):
        self.server.lag = 3
        self.send(10)
        self.server.fall_back_to(7)
        with self.assertLogs("plumescout", "WARNING"):
            self.send(1)
        self.assertEqual(self.server.log, list(range(1, 12)))

    def test_a_server_that_was_set_back_hears_what_is_gone(self):
        self.send(10)
        self.server.fall_back_to(4)
        with self.assertLogs("plumescout", "WARNING"):
            self.send(2)
        self.assertEqual(self.server.log, [1, 2, 3, 4, (5, 10), 11, 12])
        self.assertEqual(self.robot.applied_sequence, 12)

    def test_a_hole_that_is_none_of_the_servers_is_an_error(self):
        self.robot.add_gas(1, POSE, 1.0)
        self.robot.add_gas(1, POSE, 1.0)
        del self.robot._kept[0]
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            self.robot.flush()
        self.assertEqual(caught.exception.reason, "SEQUENCE_GAP")


class WaitingTest(unittest.TestCase):
    def call(self, errors, timeout_s=5.0):
        """Calls a method that fails so often before it answers."""
        client = plumescout.Client("127.0.0.1:1", timeout_s=timeout_s)
        self.addCleanup(client.close)

        def method(_request, timeout, wait_for_ready):
            self.assertLessEqual(timeout, timeout_s)
            if errors:
                raise errors.pop(0)
            return "answer"

        return client._call(method, None)

    def setUp(self):
        # The errors of gRPC have no public constructor: what error_of makes of them is given.
        original = calls_module.error_of
        calls_module.error_of = lambda error: error.told
        self.addCleanup(setattr, calls_module, "error_of", original)

    @staticmethod
    def trouble(reason, retry_after_s=0.001):
        error = grpc.RpcError()
        error.told = plumescout.PlumeScoutError(
            grpc.StatusCode.UNAVAILABLE, "later", reason, retry_after_s
        )
        return error

    def test_a_server_that_recovers_or_has_no_room_is_waited_for(self):
        errors = [self.trouble("RECOVERING"), self.trouble("STORE_UNAVAILABLE")]
        self.assertEqual(self.call(errors), "answer")

    def test_nothing_is_waited_for_longer_than_the_call_may_take(self):
        with self.assertRaises(plumescout.PlumeScoutError):
            self.call([self.trouble("RECOVERING", retry_after_s=60.0)])

    def test_a_batch_bears_the_time_of_the_try_that_gets_through(self):
        client = plumescout.Client("127.0.0.1:1", timeout_s=5.0)
        self.addCleanup(client.close)
        client._limits = types.SimpleNamespace(
            max_batch_observation_count=4, max_receive_bytes=1 << 20
        )
        errors = [self.trouble("STORE_UNAVAILABLE"), self.trouble("STORE_UNAVAILABLE")]
        stamps_ns = []

        def take(request, timeout, wait_for_ready):
            stamps_ns.append(request.batch.sent_time_ns)
            if errors:
                raise errors.pop(0)
            response = ingest_pb.BatchIngestObservationsResponse()
            response.ingest_state.applied_sequence = 1
            return response

        client._ingest = types.SimpleNamespace(BatchIngestObservations=take)
        ticks_ns = itertools.count(100)
        robot = plumescout.Robot(
            client,
            robot_pb.RegisterRobotResponse(robot="missions/m/robots/r"),
            clock_ns=lambda: next(ticks_ns),
        )
        robot.add_gas(1, POSE, 1.0)
        robot.flush()
        self.assertEqual(stamps_ns, [100, 101, 102])

    def test_other_trouble_is_the_callers(self):
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            self.call([self.trouble("OVERLOADED")])
        self.assertEqual(caught.exception.reason, "OVERLOADED")


if __name__ == "__main__":
    unittest.main()
