# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Robots that stream what they see in the room, ask for plans and report them, whatever becomes of
the server; all that they are answered goes into an Answers."""

import collections
import random
import threading
import time

import grpc

import bed
import room
from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import ingest_service_pb2_grpc as ingest_grpc
from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import mission_service_pb2_grpc as mission_grpc
from plumescout.v1 import options_pb2 as options_pb
from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import planning_service_pb2_grpc as planning_grpc
from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import robot_service_pb2_grpc as robot_grpc

OUTCOMES = {
    "reached": planning_pb.ReportProgressRequest.OUTCOME_REACHED,
    "blocked": planning_pb.ReportProgressRequest.OUTCOME_BLOCKED,
    "aborted": planning_pb.ReportProgressRequest.OUTCOME_ABORTED,
}
CALL_S = 3.0
PLAN_AGAIN_S = 0.2
MAX_REDIRECTS = 3  # followed at once, as clients do
# Reasons that go with a server that has just come back, or is busy.
PASSING = frozenset(
    {
        "DRAINING",
        "FENCED",  # who was overtaken and has not noticed yet
        "MISSION_ELSEWHERE",
        "NODE_UNREACHED",
        "OVERLOADED",
        "RECOVERING",
        "SERVER_RESTARTED",
        "STORE_UNAVAILABLE",
    }
)


class Route(grpc.UnaryUnaryClientInterceptor, grpc.StreamStreamClientInterceptor):
    """Where a mission's calls go behind a router, as the clients do it: with its name, and to the
    node that was told to have it until that does not answer. redirects: how many were told;
    failures: how many calls ended so, by reason."""

    def __init__(self, mission):
        self._mission, self._node = mission, None
        self.redirects = 0
        self.failures = collections.Counter()

    def note(self, error):
        """True: the call may be made again at once."""
        self.failures[bed.reason_of(error) or error.code().name] += 1
        if bed.reason_of(error) == "MISSION_ELSEWHERE":
            owner = dict(error.trailing_metadata() or ()).get("x-owner")
            self.redirects += owner is not None
            self._node = owner
            return owner is not None
        if bed.reason_of(error) in ("", "DRAINING", "FENCED", "STORE_UNAVAILABLE"):
            self._node = None
        return False

    def _addressed(self, details):
        metadata = [("x-mission-id", self._mission)]
        metadata += [("x-node", self._node)] if self._node else []
        return details._replace(metadata=metadata)

    def intercept_unary_unary(self, continuation, details, request):
        return continuation(self._addressed(details), request)

    def intercept_stream_stream(self, continuation, details, requests):
        return continuation(self._addressed(details), requests)


class Stubs:
    """Everything that a channel can be asked. route: of its mission, behind a router."""

    def __init__(self, target, route=None):
        self._channel = bed.channel_to(target)
        self.channel = grpc.intercept_channel(self._channel, route) if route else self._channel
        self.missions = mission_grpc.MissionServiceStub(self.channel)
        self.robots = robot_grpc.RobotServiceStub(self.channel)
        self.ingest = ingest_grpc.IngestServiceStub(self.channel)
        self.planning = planning_grpc.PlanningServiceStub(self.channel)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._channel.close()


def is_passing(error):
    return error.code() in bed.LINK_CODES or bed.reason_of(error) in PASSING


def await_answer(call, patience_s=bed.PATIENCE_S):
    """What call() returns once the server is there and able to answer."""
    deadline = time.monotonic() + patience_s
    while True:
        try:
            return call()
        except grpc.RpcError as error:
            if not is_passing(error) or time.monotonic() > deadline:
                raise
        time.sleep(0.02)


def create_mission(stubs, mission, answers=None, patience_s=bed.PATIENCE_S, **options):
    request = mission_pb.CreateMissionRequest(mission_id=mission, **options)

    def create():
        try:
            stubs.missions.CreateMission(request, timeout=CALL_S)
        except grpc.RpcError as error:  # an answer was lost
            if error.code() != grpc.StatusCode.ALREADY_EXISTS:
                raise

    await_answer(create, patience_s)
    if answers is not None:
        answers.note("created", mission)


def cheap_options():
    """A mission whose gas field costs little: what is tested is not how fast it is."""
    options = options_pb.MissionOptions()
    options.gas.lattice_factor = 4
    return options


class Outbox:
    """The frames that a robot sends on one stream: as fast as its pace and its credit allow. An
    iterator that gRPC reads on a thread of its own."""

    def __init__(self, robot, opening):
        self._robot = robot
        self._opening = opening
        self._change = threading.Condition()
        self._next = None  # number to be sent; None: not known yet
        self._credit = 0
        self._ended = False

    def opened(self, state):
        with self._change:
            self._next = state.applied_sequence + 1
            self._credit = state.credit_sequence
            self._change.notify()

    def allow(self, credit):
        with self._change:
            self._credit = max(self._credit, credit)
            self._change.notify()

    def end(self):
        with self._change:
            self._ended = True
            self._change.notify()

    def __iter__(self):
        return self

    def __next__(self):
        if self._opening is not None:
            opening, self._opening = self._opening, None
            return ingest_pb.StreamObservationsRequest(open=opening)
        self._robot.pause()
        with self._change:
            self._change.wait_for(self._may_send)
            if self._ended:
                raise StopIteration
            last = min(self._credit, self._next + self._robot.batch - 1, self._robot.limit)
            numbers = range(self._next, last + 1)
            self._next = last + 1
        batch = ingest_pb.ObservationBatch(
            observations=[room.observation(self._robot.index, n) for n in numbers]
        )
        self._robot.sent = max(self._robot.sent, last)
        return ingest_pb.StreamObservationsRequest(batch=batch)

    def _may_send(self):
        if self._ended:
            return True
        if self._next is None:
            return False
        return self._next <= min(self._credit, self._robot.limit)


class Robot:
    """One robot of a mission, on two threads: one streams, one plans. What it does not expect is in
    `breaches`. limit: it has no more observations than that. plan_waits_s: of each plan, from when it
    was asked for first until it was there; slowest_plan: the longest, and what it was told before."""

    def __init__(
        self,
        target,
        mission,
        index,
        answers,
        batch=4,
        period_s=0.03,
        limit=1 << 40,
        plan_period_s=0.2,
    ):
        self.name = f"robot-{index}"
        self.index = index
        self.batch = batch
        self.limit = limit
        self.sent = 0
        self.streams = 0  # opened
        self.plans = 0
        self.plan_waits_s = []
        self.slowest_plan = (0.0, [])
        self.breaches = []
        self.last_acknowledged_s = None  # of the monotonic clock: when durable last grew
        self._mission = mission
        self._answers = answers
        self._period_s = period_s
        self._plan_period_s = plan_period_s
        self._told = []  # reasons, since then
        self._asked_s = None  # when the plan that is not there yet was asked for first
        self.resource = f"missions/{mission}/robots/{self.name}"
        self._log_epoch = random.getrandbits(52) + 1
        self._token = 0
        self._durable = 0
        self._unanswered = False  # a registration that may have been carried out
        self._target = target
        self.route = Route(mission)
        self._stubs = Stubs(target, self.route)
        self._stopping = threading.Event()
        self._call = None
        self._threads = [threading.Thread(target=self._stream), threading.Thread(target=self._plan)]

    @property
    def durable(self):
        return self._durable

    def start(self):
        for thread in self._threads:
            thread.start()
        return self

    def stop(self):
        self._stopping.set()
        if self._call is not None:
            self._call.cancel()
        for thread in self._threads:
            thread.join()
        self._stubs.close()

    def pause(self):
        self._stopping.wait(self._period_s)

    def _breach(self, text):
        self.breaches.append(f"{self.name}: {text}")

    def register(self):
        """Registers, or raises grpc.RpcError."""
        request = robot_pb.RegisterRobotRequest(
            mission=f"missions/{self._mission}",
            robot_id=self.name,
            radius_m=0.2,
            take_over=True,
            log_epoch=self._log_epoch,
        )
        self._unanswered = True
        answer = self._stubs.robots.RegisterRobot(request, timeout=CALL_S)
        self._unanswered = False
        if answer.lease_token <= self._token:
            self._breach(f"lease token {answer.lease_token} after {self._token}")
        if self.sent > 0 and not answer.log_continues and answer.ingest_state.applied_sequence > 0:
            self._breach("the server takes its log for another one")
        self._token = answer.lease_token
        self._answers.note("registered", self._mission, self.name, answer.lease_token)
        self._take(answer.ingest_state)

    def _take(self, state):
        if state.applied_sequence > self.sent:
            self._breach(f"{state.applied_sequence} are applied, sent were {self.sent}")
        if state.applied_sequence < self._durable:
            self._breach(f"{state.applied_sequence} are applied, durable were {self._durable}")
        if state.durable_sequence > state.applied_sequence:
            self._breach(f"durable {state.durable_sequence} > applied {state.applied_sequence}")
        if state.durable_sequence > self._durable:
            self._durable = state.durable_sequence
            self.last_acknowledged_s = time.monotonic()
            self._answers.note("durable", self._mission, self.name, self._durable)

    def _stream(self):
        lives = 0
        while not self._stopping.is_set():
            # Some come back by the lease that they have, others register anew.
            lives += 1
            try:
                if self._token == 0 or (lives + self.index) % 2 == 0:
                    self.register()
                self._stream_once()
            except grpc.RpcError as error:
                self._note_end(error)
                if bed.reason_of(error) != "MISSION_ELSEWHERE":  # plans may be under way on it
                    self._reconnect()
            self._stopping.wait(0.05)

    def _reconnect(self):
        old, self._stubs = self._stubs, Stubs(self._target, self.route)
        old.close()

    def _note_end(self, error):
        self.route.note(error)
        if self._stopping.is_set() or is_passing(error):
            return
        reason = bed.reason_of(error)
        if reason == "LEASE_SUPERSEDED" and self._unanswered:
            self._token = 0  # the answer with the newer one was lost
            return
        self._breach(f"{error.code().name} {reason}: {error.details()}")

    def _stream_once(self):
        opening = ingest_pb.OpenIngest(
            robot=self.resource, lease_token=self._token, durable_sequence=self._durable
        )
        outbox = Outbox(self, opening)
        self._call = self._stubs.ingest.StreamObservations(outbox)
        try:
            for response in self._call:
                kind = response.WhichOneof("frame")
                if kind == "opened":
                    self.streams += 1
                    self._take(response.opened.ingest_state)
                    outbox.opened(response.opened.ingest_state)
                elif kind == "ack":
                    self._take(response.ack)
                    outbox.allow(response.ack.credit_sequence)
                else:
                    self._breach(f"refused: {response.rejected}")
        finally:
            outbox.end()
            self._call.cancel()

    def _plan(self):
        wait_s, redirects = self._plan_period_s, 0
        while not self._stopping.wait(wait_s):
            wait_s = self._plan_period_s
            if self._token == 0:
                continue
            try:
                self._plan_once()
                redirects = 0
            except ValueError:
                wait_s = PLAN_AGAIN_S
                continue  # the channel was closed meanwhile
            except grpc.RpcError as error:
                follows = self.route.note(error) and redirects < MAX_REDIRECTS
                redirects, wait_s = (redirects + 1, 0.0) if follows else (0, PLAN_AGAIN_S)
                self._told.append(bed.reason_of(error) or error.code().name)
                # No map yet, or the other thread has registered meanwhile.
                expected = error.code() == grpc.StatusCode.FAILED_PRECONDITION
                if not (expected or is_passing(error) or self._stopping.is_set()):
                    self._breach(f"plan: {error.code().name}: {error.details()}")

    def _plan_once(self):
        request = planning_pb.NextBestTrajectoryRequest(
            robot=self.resource, lease_token=self._token, max_edge_evaluation_count=300
        )
        request.planning_budget.FromMilliseconds(100)
        self._asked_s = self._asked_s or time.monotonic()
        plan = self._stubs.planning.NextBestTrajectory(request, timeout=CALL_S).plan
        self.plan_waits_s.append(time.monotonic() - self._asked_s)
        self.slowest_plan = max(self.slowest_plan, (self.plan_waits_s[-1], self._told))
        self._asked_s, self._told = None, []
        number = int(plan.name.rsplit("/", 1)[-1])
        self.plans += 1
        self._answers.note("plan", self._mission, number, self.name)
        outcome = random.choice(list(OUTCOMES))
        report = planning_pb.ReportProgressRequest(
            robot=self.resource,
            lease_token=self._token,
            plan=plan.name,
            outcome=OUTCOMES[outcome],
        )
        self._stubs.planning.ReportProgress(report, timeout=CALL_S)
        self._answers.note("report", self._mission, number, self.name, outcome)


def names(count):
    """{name: index} of the first robots."""
    return {f"robot-{index}": index for index in range(count)}
