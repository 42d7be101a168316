# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What a robot of the Python client keeps, and tells a server that lost or does not take it;
without a server, for operations only say what is to be done."""

import itertools
import math
import unittest

import grpc
import numpy as np
import plumescout
from plumescout import _operation, rpcs
from plumescout._client import Operations
from plumescout._log import Log
from plumescout.plans import plan_of, pose_of
from plumescout.practice import Room

from fake_robot_server import LINK_BROKE, FakeServer, refusal

from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import system_service_pb2 as system_pb

POSE = (0.0, 0.0, 0.0)


class RobotTest(unittest.TestCase):
    def setUp(self):
        self.server = FakeServer()
        self.operations = Operations(timeout_s=5.0)
        self.ticks_ns = itertools.count(100)
        self.robot = self.register()

    def register(self, **arguments):
        arguments = {"clock_ns": lambda: next(self.ticks_ns)} | arguments
        robot = self.server.run(self.operations.register("m", "r", **arguments))
        self.server.calls.clear()
        return robot

    def send(self, count, **how):
        for _ in range(count):
            self.robot.add_gas(1, POSE, 1.0)
        self.server.run(self.robot.flush(**how))

    def batches(self):
        requests = [q for rpc, q in self.server.calls if rpc is rpcs.BATCH_INGEST_OBSERVATIONS]
        return [[o.sequence for o in request.batch.observations] for request in requests]

    def test_batches_are_as_large_as_the_server_takes(self):
        self.send(6, stream=False)
        self.assertEqual(self.batches(), [[1, 2, 3, 4], [5, 6]])

    def test_what_is_more_than_a_batch_is_streamed(self):
        self.send(10)
        self.assertEqual(self.server.log, list(range(1, 11)))
        self.assertEqual(self.batches(), [])
        self.assertEqual(self.robot.log.applied_sequence, 10)

    def test_what_is_durable_is_forgotten(self):
        self.server.lag = 3
        self.send(10)
        self.assertEqual(self.robot.log.durable_sequence, 7)
        self.assertEqual(self.robot.log.kept_count, 3)

    def test_what_was_not_durable_is_told_again_after_a_crash(self):
        for stream in (False, True):
            with self.subTest(stream=stream):
                self.setUp()
                self.server.lag = 3
                self.send(10)
                self.server.fall_back_to(7)
                with self.assertLogs("plumescout", "WARNING"):
                    self.send(1, stream=stream)
                self.assertEqual(self.server.log, list(range(1, 12)))

    def test_a_server_that_was_set_back_hears_what_is_gone(self):
        for stream in (False, True):
            with self.subTest(stream=stream):
                self.setUp()
                self.send(10)
                self.server.fall_back_to(4)
                with self.assertLogs("plumescout", "WARNING"):
                    self.send(2, stream=stream)
                self.assertEqual(self.server.log, [1, 2, 3, 4, (5, 10), 11, 12])
                self.assertEqual(self.robot.log.applied_sequence, 12)

    def test_a_server_that_lost_everything_is_told_everything_under_a_new_lease(self):
        self.robot = self.register(take_over=True)
        self.server.keeps = False
        self.send(3)
        self.server.lose_everything()
        with self.assertLogs("plumescout", "WARNING"):
            self.send(1)
        self.assertEqual(self.server.log, [1, 2, 3, 4])
        registrations = [q for rpc, q in self.server.calls if rpc is rpcs.REGISTER_ROBOT]
        self.assertEqual(len(registrations), 1)
        self.assertFalse(registrations[0].take_over)
        self.assertEqual(registrations[0].log_epoch, self.robot._request.log_epoch)

    def test_a_robot_that_was_removed_stays_away(self):
        self.send(3)
        self.server.knows_robot = False
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            self.send(1)
        self.assertEqual(caught.exception.reason, "ROBOT_NOT_FOUND")

    def test_what_another_log_has_not_is_numbered_after_it(self):
        self.server.keeps = False
        self.send(3)
        self.server.lose_everything()
        self.server.log, self.server.log_continues = list(range(1, 21)), False
        self.send(2)
        self.assertEqual(self.server.log, list(range(1, 23)))
        self.assertEqual(self.robot.log.last_sequence, 22)

    def test_a_hole_that_is_none_of_the_servers_is_an_error(self):
        self.robot.add_gas(1, POSE, 1.0)
        self.robot.add_gas(1, POSE, 1.0)
        del self.robot.log._kept[0]
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            self.server.run(self.robot.flush())
        self.assertEqual(caught.exception.reason, "SEQUENCE_GAP")

    def observe(self, count):
        if self.robot.log.last_sequence < 100:  # or who waits for all would do so for ever
            for _ in range(count):
                self.robot.add_gas(1, POSE, 1.0)

    def test_who_goes_on_observing_waits_for_what_was_there_alone(self):
        for stream in (False, True):
            with self.subTest(stream=stream):
                self.setUp()
                self.server.meanwhile = lambda: self.observe(4)
                self.send(10, stream=stream)
                self.assertGreaterEqual(self.server.applied, 10)
                self.assertEqual(self.robot.log.applied_sequence, self.server.applied)
                self.assertLess(self.server.applied, self.robot.log.last_sequence)
                self.assertLess(self.robot.log.last_sequence, 100)

    def test_who_goes_on_observing_gets_a_plan_that_knows_what_was_sent(self):
        self.server.meanwhile = lambda: self.observe(1)
        self.robot.add_gas(1, POSE, 1.0)
        self.server.run(self.robot.next_best_trajectory())
        self.assertEqual(self.server.calls[-1][1].min_applied_sequence, 1)
        self.robot.add_gas(1, POSE, 1.0)
        self.server.run(self.robot.check_path([(0.0, 0.0)], "home"))
        self.assertEqual(self.server.calls[-1][1].min_applied_sequence, 3)
        self.assertEqual(self.robot.log.last_sequence, 4)

    def test_a_batch_bears_the_time_of_the_try_that_gets_through(self):
        full = refusal(grpc.StatusCode.UNAVAILABLE, "STORE_UNAVAILABLE", retry_after_s=0.001)
        self.server.errors = [full, LINK_BROKE]
        self.send(1)
        times_ns = [q.batch.sent_time_ns for _, q in self.server.calls[-3:]]
        self.assertEqual(times_ns, [100, 101, 102])
        self.assertEqual(self.server.slept_s[0], 0.001)

    def test_a_clock_of_nobody_is_not_told(self):
        self.robot = self.register(clock_ns=None)
        self.send(1)
        self.assertEqual(self.server.calls[-1][1].batch.sent_time_ns, 0)


class LogTest(unittest.TestCase):
    LIMITS = system_pb.ServerLimits(max_receive_bytes=1 << 20, max_batch_observation_count=1000)

    def test_the_oldest_go_when_it_is_full_and_are_declared(self):
        one = ingest_pb.Observation(sequence=1, sample_time_ns=1)
        log = Log(0, max_kept_bytes=20 * one.ByteSize())
        for _ in range(30):
            log.add(ingest_pb.Observation(sample_time_ns=1))
        batch = log.batch(self.LIMITS, after=0).observations
        self.assertGreaterEqual(log.lost_count, 10)
        self.assertEqual(batch[0].gap.first_sequence, 1)
        self.assertEqual(batch[0].gap.last_sequence, log.lost_count)
        self.assertEqual([o.sequence for o in batch[1:]], list(range(log.lost_count + 1, 31)))

    def test_what_was_applied_goes_without_a_gap(self):
        one = ingest_pb.Observation(sequence=1, sample_time_ns=1)
        log = Log(0, max_kept_bytes=20 * one.ByteSize())
        for _ in range(15):
            log.add(ingest_pb.Observation(sample_time_ns=1))
        log.note(ingest_pb.IngestState(applied_sequence=15))
        for _ in range(15):
            log.add(ingest_pb.Observation(sample_time_ns=1))
        batch = log.batch(self.LIMITS, after=15).observations
        self.assertEqual([o.sequence for o in batch], list(range(16, 31)))
        self.assertEqual(log.lost_count, 0)

    def test_of_a_gap_the_rest_is_told(self):
        log = Log(0)
        for _ in range(5):
            log.add(ingest_pb.Observation())
        del log._kept[:3]
        log.go_back(0)
        first, fourth, _ = log.batch(self.LIMITS, after=2).observations
        self.assertEqual((first.sequence, first.gap.first_sequence), (3, 3))
        self.assertEqual((first.gap.last_sequence, fourth.sequence), (3, 4))
        log.note(ingest_pb.IngestState(applied_sequence=5, durable_sequence=5))
        self.assertEqual(log.kept_count, 0)

    def test_nothing_goes_out_beyond_the_credit(self):
        log = Log(0)
        for _ in range(5):
            log.add(ingest_pb.Observation())
        batch = log.batch(self.LIMITS, after=1, credit=3).observations
        self.assertEqual([o.sequence for o in batch], [2, 3])


class CallTest(unittest.TestCase):
    """How calls are made again."""

    def call(self, rpc, request, outcomes, timeout_s=5.0):
        """outcomes: of the tries, one after the other. Returns the requests, and what was slept."""
        operation = Operations(timeout_s).call(rpc, request)
        progress = _operation.Progress(operation)
        names, slept_s = [], []
        while (effect := progress.advance()) is not None:
            if isinstance(effect, _operation.Sleep):
                slept_s.append(effect.seconds)
                continue
            self.assertLessEqual(effect.timeout_s, timeout_s)
            names.append(getattr(effect.request, "request_id", ""))
            outcome = outcomes.pop(0)
            if isinstance(outcome, plumescout.PlumeScoutError):
                progress.fail(outcome)
            else:
                progress.give(outcome)
        return names, slept_s

    def later(self, reason, retry_after_s=0.25):
        return refusal(grpc.StatusCode.UNAVAILABLE, reason, retry_after_s=retry_after_s)

    def test_a_server_that_recovers_or_has_no_room_is_waited_for(self):
        outcomes = [self.later("RECOVERING"), self.later("STORE_UNAVAILABLE"), "answer"]
        _, slept_s = self.call(rpcs.GET_MISSION, mission_pb.GetMissionRequest(), outcomes)
        self.assertEqual(slept_s, [0.25, 0.25])

    def test_nothing_is_waited_for_longer_than_the_call_may_take(self):
        outcomes = [self.later("RECOVERING", retry_after_s=60.0)]
        with self.assertRaises(plumescout.PlumeScoutError):
            self.call(rpcs.GET_MISSION, mission_pb.GetMissionRequest(), outcomes)

    def test_waits_for_a_broken_link_grow(self):
        outcomes = [LINK_BROKE] * 3 + ["answer"]
        request = mission_pb.GetMissionRequest()
        _, slept_s = self.call(rpcs.GET_MISSION, request, outcomes, timeout_s=60.0)
        for slept, base_s in zip(slept_s, (0.1, 0.16, 0.256)):
            self.assertLessEqual(abs(slept / base_s - 1), 0.2 + 1e-9)

    def test_a_request_that_is_made_again_keeps_its_name(self):
        request = mission_pb.CreateMissionRequest()
        names, _ = self.call(rpcs.CREATE_MISSION, request, [LINK_BROKE, "answer"])
        self.assertEqual(len(set(names)), 1)
        self.assertTrue(names[0])

    def test_what_may_have_been_done_is_not_done_twice(self):
        with self.assertRaises(plumescout.PlumeScoutError):
            self.call(rpcs.DELETE_MISSION, mission_pb.DeleteMissionRequest(), [LINK_BROKE])

    def test_other_trouble_is_the_callers(self):
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            reached = refusal(grpc.StatusCode.RESOURCE_EXHAUSTED, "LIMIT_REACHED")
            self.call(rpcs.GET_MISSION, mission_pb.GetMissionRequest(), [reached])
        self.assertEqual(caught.exception.reason, "LIMIT_REACHED")


class PracticeTest(unittest.TestCase):
    def plan(self, *poses):
        plan = planning_pb.Plan(chosen_index=-1)
        for pose in poses:
            plan.trajectory.waypoints.add().pose.CopyFrom(pose_of(pose))
        return plan_of(plan)

    def test_a_way_is_taken_step_by_step(self):
        way = list(self.plan((0, 0, 0), (1, 0, 0), (1, 0, 2), (1, 0.3, 2)).every(0.4))
        self.assertEqual(way[2], (1.0, 0.0, 0.0))
        self.assertEqual(way[3], (1.0, 0.0, 2.0))  # on the spot
        self.assertEqual(way[-1], (1.0, 0.3, 2.0))
        places = [(0.0, 0.0)] + [pose[:2] for pose in way]
        self.assertLessEqual(max(map(math.dist, places, places[1:])), 0.4)

    def test_a_plan_to_stay_has_no_way(self):
        self.assertEqual(list(self.plan((0, 0, 0)).every(0.2)), [])

    def test_beams_in_a_room_end_at_its_walls(self):
        room = Room(width_m=6.0, depth_m=4.0, leak_m=(4.5, 3.0), beams=4, max_range_m=4.5)
        ranges_m, start_rad, step_rad, max_range_m = room.scan((1.0, 1.0, 0.0))
        np.testing.assert_allclose(ranges_m, [np.inf, 3.0, 1.0, 1.0])
        self.assertEqual((start_rad, step_rad, max_range_m), (0.0, math.tau / 4, 4.5))
        np.testing.assert_allclose(room.scan((1.0, 1.0, math.pi))[0], [1.0, 1.0, np.inf, 3.0])

    def test_gas_is_thickest_at_the_leak(self):
        room = Room(width_m=6.0, depth_m=4.0, leak_m=(4.5, 3.0))
        self.assertEqual(room.gas_ppm((4.5, 3.0, 1.0)), 20.0)
        self.assertAlmostEqual(room.gas_ppm((4.5, 2.0, 0.0)), 20.0 / math.e)


if __name__ == "__main__":
    unittest.main()
