# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""The Python clients before several servers: calls go to the one that has the mission."""

import asyncio
import concurrent.futures
import unittest

import grpc
import plumescout
import plumescout.aio
import running
from google.rpc import error_details_pb2, status_pb2

from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import ingest_service_pb2_grpc as ingest_grpc
from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import mission_service_pb2_grpc as mission_grpc
from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import robot_service_pb2_grpc as robot_grpc
from plumescout.v1 import system_service_pb2 as system_pb
from plumescout.v1 import system_service_pb2_grpc as system_grpc


class Nodes(
    mission_grpc.MissionServiceServicer,
    robot_grpc.RobotServiceServicer,
    ingest_grpc.IngestServiceServicer,
    system_grpc.SystemServiceServicer,
):
    """Nodes behind one address: a call goes to the one that it names, or else to n1. All missions
    are at `owner`; calls that come to `dead` end as a front ends them."""

    def __init__(self):
        self.owner, self.dead, self.death = "n2", None, grpc.StatusCode.UNKNOWN
        self.calls = []
        self._server = grpc.server(concurrent.futures.ThreadPoolExecutor(4))
        mission_grpc.add_MissionServiceServicer_to_server(self, self._server)
        robot_grpc.add_RobotServiceServicer_to_server(self, self._server)
        ingest_grpc.add_IngestServiceServicer_to_server(self, self._server)
        system_grpc.add_SystemServiceServicer_to_server(self, self._server)
        self.target = f"127.0.0.1:{self._server.add_insecure_port('127.0.0.1:0')}"
        self._server.start()

    def stop(self):
        self._server.stop(None).wait()

    def taken(self):
        """(method, mission, node) of each call since the last look."""
        calls, self.calls = self.calls, []
        return calls

    def _enter(self, what, context):
        metadata = dict(context.invocation_metadata())
        node = metadata.get("x-node", "")
        self.calls.append((what, metadata.get("x-mission-id", ""), node))
        if (node or "n1") == self.dead:
            context.abort(self.death, "No status received")
        if (node or "n1") != self.owner:
            status = status_pb2.Status(code=grpc.StatusCode.UNAVAILABLE.value[0])
            status.details.add().Pack(error_details_pb2.ErrorInfo(reason="MISSION_ELSEWHERE"))
            details = ("grpc-status-details-bin", status.SerializeToString())
            context.set_trailing_metadata((("x-owner", self.owner), details))
            context.abort(grpc.StatusCode.UNAVAILABLE, "it is elsewhere")

    def GetServerInfo(self, request, context):
        limits = system_pb.ServerLimits(max_receive_bytes=1 << 18, max_batch_observation_count=512)
        return system_pb.GetServerInfoResponse(limits=limits)

    def GetMission(self, request, context):
        self._enter("get", context)
        return mission_pb.GetMissionResponse(mission=mission_pb.Mission(name=request.name))

    def RegisterRobot(self, request, context):
        self._enter("register", context)
        robot = f"{request.mission}/robots/{request.robot_id}"
        return robot_pb.RegisterRobotResponse(robot=robot, lease_token=1)

    def WatchRobot(self, request, context):
        self._enter("watch", context)
        yield robot_pb.WatchRobotResponse()

    def StreamObservations(self, requests, context):
        self._enter("stream", context)
        state = ingest_pb.IngestState(credit_sequence=100)
        yield ingest_pb.StreamObservationsResponse(opened={"ingest_state": state})
        for request in requests:
            for observation in request.batch.observations:
                state.applied_sequence = observation.sequence
            yield ingest_pb.StreamObservationsResponse(ack=state)


class RoutesTest(unittest.TestCase):
    def setUp(self):
        self.nodes = Nodes()
        self.addCleanup(self.nodes.stop)
        self.client = plumescout.Client(self.nodes.target, running.PATIENCE_S)
        self.addCleanup(self.client.close)

    def test_calls_go_where_the_mission_is_and_are_remembered_there(self):
        self.client.get_mission("house")
        self.client.get_mission("house")
        self.client.get_mission("yard")
        self.assertEqual(
            self.nodes.taken(),
            [
                ("get", "house", ""),
                ("get", "house", "n2"),
                ("get", "house", "n2"),
                ("get", "yard", ""),
                ("get", "yard", "n2"),
            ],
        )

    def test_a_node_that_does_not_answer_is_forgotten(self):
        for code in ("UNKNOWN", "INTERNAL", "UNAVAILABLE"):
            self.nodes.owner, self.nodes.dead = "n2", None
            self.client.get_mission(code)
            self.nodes.taken()
            self.nodes.owner, self.nodes.dead = "n1", "n2"
            self.nodes.death = grpc.StatusCode[code]
            self.client.get_mission(code)
            self.assertEqual(self.nodes.taken(), [("get", code, "n2"), ("get", code, "")])

    def test_nodes_that_send_a_call_round_in_circles_are_asked_later(self):
        self.nodes.owner = "two words"
        with plumescout.Client(self.nodes.target, timeout_s=0.25) as client:
            with self.assertRaises(plumescout.PlumeScoutError) as caught:
                client.get_mission("house")
        self.assertEqual(caught.exception.reason, "MISSION_ELSEWHERE")
        self.assertLess(len(self.nodes.taken()), 5)

    def test_streams_go_there_too(self):
        robot = self.client.register("house", "scout")
        robot.add_gas(1, (1.0, 1.0, 0.0), 5.0)
        self.nodes.owner = "n3"
        robot.flush(stream=True)
        self.assertEqual(next(self.client.watch_robot("house", "scout")).WhichOneof("notice"), None)
        self.assertEqual(
            self.nodes.taken(),
            [
                ("register", "house", ""),
                ("register", "house", "n2"),
                ("stream", "house", "n2"),
                ("stream", "house", "n3"),
                ("watch", "house", "n3"),
            ],
        )
        self.nodes.owner = "n1"
        next(self.client.watch_robot("house", "scout"))
        self.assertEqual(self.nodes.taken(), [("watch", "house", "n3"), ("watch", "house", "n1")])

    def test_asyncio_does_the_same(self):
        async def get():
            async with plumescout.aio.Client(self.nodes.target, running.PATIENCE_S) as client:
                await client.get_mission("house")
                async for _ in client.watch_robot("house", "scout"):
                    return

        asyncio.run(get())
        self.assertEqual(
            self.nodes.taken(),
            [("get", "house", ""), ("get", "house", "n2"), ("watch", "house", "n2")],
        )


if __name__ == "__main__":
    unittest.main()
