# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A short session of every kind of call that changes something, half a second long. What is
answered goes into an Answers; what fails is kept."""

import grpc

import bed
import robots
import room
from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import robot_service_pb2 as robot_pb

MISSIONS = ("house", "cellar", "attic")
ROBOTS = 2
LOG_EPOCH = 4711
# Stages of a session: so many observations of each robot.
STAGES = (13, 26, 39)


class Session:
    """failures: (step, code, reason, message) of calls that were refused or broke off."""

    def __init__(self, target, told, call_s=1.5):
        self.failures = []
        self._told = told
        self._call_s = call_s
        self._target = target
        self._tokens = {}

    def run(self):
        """Goes through all steps; one that depends on one that failed is left out."""
        with robots.Stubs(self._target) as stubs:
            self._stubs = stubs
            for mission in MISSIONS:
                self._try("create", self._create, mission)
            for stage in STAGES:
                if stage == STAGES[1]:
                    self._try("delete", self._delete, "attic")
                for mission in MISSIONS[:2]:
                    for index in range(ROBOTS):
                        self._robot_step(mission, index, stage)
            self._try("pause", self._pause, "cellar")
        return self

    def _try(self, step, call, *values):
        try:
            call(*values)
            return True
        except grpc.RpcError as error:
            self.failures.append((step, error.code(), bed.reason_of(error), error.details()))
            return False

    def _robot_step(self, mission, index, last):
        name = f"robot-{index}"
        if (mission, name) not in self._tokens:
            if not self._try("register", self._register, mission, name):
                return
        if self._try("ingest", self._ingest, mission, name, index, last):
            self._try("plan", self._plan, mission, name)

    def _create(self, mission):
        request = mission_pb.CreateMissionRequest(mission_id=mission)
        self._stubs.missions.CreateMission(request, timeout=self._call_s)
        self._told.note("created", mission)

    def _register(self, mission, name):
        request = robot_pb.RegisterRobotRequest(
            mission=f"missions/{mission}",
            robot_id=name,
            radius_m=0.2,
            take_over=True,
            log_epoch=LOG_EPOCH,
        )
        answer = self._stubs.robots.RegisterRobot(request, timeout=self._call_s)
        self._tokens[mission, name] = answer.lease_token
        self._told.note("registered", mission, name, answer.lease_token)
        self._note(mission, name, answer.ingest_state)

    def _note(self, mission, name, state):
        self._told.note("durable", mission, name, state.durable_sequence)

    def _batch(self, mission, name, index, first, last):
        return ingest_pb.BatchIngestObservationsRequest(
            open=ingest_pb.OpenIngest(
                robot=f"missions/{mission}/robots/{name}", lease_token=self._tokens[mission, name]
            ),
            batch=ingest_pb.ObservationBatch(
                observations=[room.observation(index, n) for n in range(first, last + 1)]
            ),
        )

    def _ingest(self, mission, name, index, last):
        first = max(1, last - STAGES[0] + 1)
        request = self._batch(mission, name, index, first, last)
        answer = self._stubs.ingest.BatchIngestObservations(request, timeout=self._call_s)
        self._note(mission, name, answer.ingest_state)

    def _plan(self, mission, name):
        robot = f"missions/{mission}/robots/{name}"
        token = self._tokens[mission, name]
        request = planning_pb.NextBestTrajectoryRequest(
            robot=robot, lease_token=token, max_edge_evaluation_count=100
        )
        request.planning_budget.FromMilliseconds(100)
        plan = self._stubs.planning.NextBestTrajectory(request, timeout=self._call_s).plan
        number = int(plan.name.rsplit("/", 1)[-1])
        self._told.note("plan", mission, number, name)
        report = planning_pb.ReportProgressRequest(
            robot=robot,
            lease_token=token,
            plan=plan.name,
            outcome=robots.OUTCOMES["reached"],
        )
        self._stubs.planning.ReportProgress(report, timeout=self._call_s)
        self._told.note("report", mission, number, name, "reached")

    def _pause(self, mission):
        request = mission_pb.PauseMissionRequest(name=f"missions/{mission}")
        self._stubs.missions.PauseMission(request, timeout=self._call_s)
        self._told.note("paused", mission)

    def _delete(self, mission):
        self._told.note("deleting", mission)
        request = mission_pb.DeleteMissionRequest(name=f"missions/{mission}")
        self._stubs.missions.DeleteMission(request, timeout=self._call_s)
        self._told.note("deleted", mission)


def kept_promises(target, told, until=None, patience_s=bed.PATIENCE_S):
    """[sentence ...]: what a server that came back says otherwise than it was answered before.
    patience_s: for each mission to be recovered."""
    breaches = []
    with robots.Stubs(target) as stubs:
        for mission in told.missions(until):
            request = mission_pb.GetMissionRequest(name=f"missions/{mission}")
            call = lambda: stubs.missions.GetMission(request, timeout=2.0)
            try:
                state = robots.await_answer(call, patience_s).mission.state
            except grpc.RpcError as error:
                breaches.append(f"{mission}: {error.code().name} {error.details()}")
                continue
            paused = state == mission_pb.MISSION_STATE_PAUSED
            if told.of("paused", mission, until) and not paused:
                breaches.append(f"{mission}: was paused, and is not")
            breaches += _robot_breaches(stubs, told, mission, until)
    return breaches


def _robot_breaches(stubs, told, mission, until):
    for name in dict(told.of("registered", mission, until)):
        request = robot_pb.GetRobotRequest(name=f"missions/{mission}/robots/{name}")
        try:
            robot = stubs.robots.GetRobot(request, timeout=2.0).robot
        except grpc.RpcError as error:
            yield f"{mission} {name}: {error.code().name} {error.details()}"
            continue
        durable = told.durable(mission, name, until)
        if robot.on_map.applied_sequence < durable:
            yield f"{mission} {name}: {durable} durable, {robot.on_map.applied_sequence} applied"
