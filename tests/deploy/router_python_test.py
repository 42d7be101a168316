# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""The shipped router before nodes: what goes where, and what becomes of calls when nodes go.

The nodes are small servers of the same wire, so that each can be made to drain, hang or die by
itself; cluster_python_test and tests/faults have real ones.
"""

import collections
import concurrent.futures
import http.server
import os
import socket
import subprocess
import threading
import unittest

import grpc
import plumescout
import running
from google.rpc import error_details_pb2, status_pb2

from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import mission_service_pb2_grpc as mission_grpc
from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import robot_service_pb2_grpc as robot_grpc

NAMES = ("n1", "n2", "n3")
MISSIONS = [f"mission-{i}" for i in range(120)]


class Node(mission_grpc.MissionServiceServicer, robot_grpc.RobotServiceServicer):
    """Serves every mission that `owners` does not give to another. ready: what it says of itself; a
    node that hangs says nothing."""

    def __init__(self, name, owners):
        self.name, self.owners, self.ready, self.hangs = name, owners, True, threading.Event()
        self.named, self.unreached = [], []  # x-node and x-unreached of calls
        self._grpc = grpc.server(concurrent.futures.ThreadPoolExecutor(16))
        mission_grpc.add_MissionServiceServicer_to_server(self, self._grpc)
        robot_grpc.add_RobotServiceServicer_to_server(self, self._grpc)
        self.port = self._grpc.add_insecure_port("127.0.0.1:0")
        self._grpc.start()
        node = self

        class Readiness(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                if node.hangs.is_set():
                    return running.await_that(lambda: not node.hangs.is_set(), "it goes on")
                good = node.ready and self.path == "/readyz"
                self.send_response(200 if good else 503)
                self.end_headers()

            def log_message(self, *_):
                pass

        self._http = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Readiness)
        self._http.daemon_threads = True
        self.http_port = self._http.server_port
        threading.Thread(target=self._http.serve_forever).start()

    def stop(self):
        self.hangs.clear()
        self._http.shutdown()
        self._http.server_close()
        self.die()

    def die(self):
        """It listens no more, and does not know yet that it is not ready."""
        self._grpc.stop(None).wait()

    def GetMission(self, request, context):
        mission = request.name.removeprefix("missions/")
        metadata = dict(context.invocation_metadata())
        self.named.append(metadata.get("x-node"))
        self.unreached.append(metadata.get("x-unreached"))
        owner = self.owners.get(mission, self.name)
        if owner != self.name:
            status = status_pb2.Status(code=grpc.StatusCode.UNAVAILABLE.value[0])
            status.details.add().Pack(error_details_pb2.ErrorInfo(reason="MISSION_ELSEWHERE"))
            details = ("grpc-status-details-bin", status.SerializeToString())
            context.set_trailing_metadata((("x-owner", owner), details))
            context.abort(grpc.StatusCode.UNAVAILABLE, "it is elsewhere")
        mission = mission_pb.Mission(name=request.name, owner=self.name)
        return mission_pb.GetMissionResponse(mission=mission)

    def WatchRobot(self, request, context):
        yield robot_pb.WatchRobotResponse()
        ended = threading.Event()
        context.add_callback(ended.set)
        ended.wait(running.PATIENCE_S)


class RouterTest(unittest.TestCase):
    def setUp(self):
        self.owners = {}
        self.nodes = {name: Node(name, self.owners) for name in NAMES}
        port = running.free_port()
        environment = dict(os.environ, PLUMESCOUT_ROUTER_BIND=f"127.0.0.1:{port}")
        environment["PLUMESCOUT_ROUTER_PLAINTEXT"] = "1"
        for number, node in enumerate(self.nodes.values(), start=1):
            self.addCleanup(node.stop)
            environment[f"PLUMESCOUT_NODE_{number}"] = f"127.0.0.1:{node.port}"
            environment[f"PLUMESCOUT_NODE_{number}_HTTP"] = str(node.http_port)
        configuration = running.ROOT / "deploy/cluster/haproxy.cfg"
        router = subprocess.Popen(
            [os.environ["PLUMESCOUT_HAPROXY"], "-db", "-f", configuration],
            env=environment,
            stdout=subprocess.DEVNULL,
        )
        self.addCleanup(router.wait)
        self.addCleanup(router.kill)
        self.target = f"127.0.0.1:{port}"
        running.await_that(self.listens, "the router listens")
        self.client = plumescout.Client(self.target, running.PATIENCE_S)
        self.addCleanup(self.client.close)
        self.stub = mission_grpc.MissionServiceStub(self.client.driver.channel)

    def listens(self):
        host, port = self.target.split(":")
        try:
            socket.create_connection((host, int(port))).close()
            return True
        except OSError:
            return False

    def where(self, mission, node=None):
        """The node that a call comes to, which says besides what only the router may."""
        metadata = [("x-mission-id", mission), ("x-unreached", "n1")]
        metadata += [("x-node", node)] if node else []
        request = mission_pb.GetMissionRequest(name=f"missions/{mission}")
        answer = self.stub.GetMission(request, metadata=metadata, timeout=running.PATIENCE_S)
        return answer.mission.owner

    def places(self):
        return {mission: self.where(mission) for mission in MISSIONS}

    def await_places(self, condition, what):
        def look():
            try:
                places = self.places()
            except grpc.RpcError:
                return None
            return places if condition(places) else None

        return running.await_that(look, what)

    def test_missions_are_spread_and_stay_while_nodes_go_and_come(self):
        before = self.places()
        self.assertEqual(set(before.values()), set(NAMES))
        self.assertGreater(min(collections.Counter(before.values()).values()), len(MISSIONS) // 10)
        self.assertEqual(self.places(), before)
        self.nodes["n2"].ready = False
        without = self.await_places(lambda p: "n2" not in p.values(), "n2 gets no calls")
        for mission, node in before.items():
            if node != "n2":
                self.assertEqual(without[mission], node, "only those of n2 move")
        self.nodes["n2"].ready = True
        self.await_places(lambda p: p == before, "all are back where they were")

    def test_a_name_of_the_list_wins_and_others_are_not_heard(self):
        for node in NAMES:
            self.assertEqual({self.where(m, node) for m in MISSIONS[:9]}, {node})
        for node in self.nodes.values():
            node.named.clear()
        self.assertEqual(self.where("house", "n4"), self.where("house"))
        self.assertEqual({n for node in self.nodes.values() for n in node.named}, {None})
        self.assertEqual({n for node in self.nodes.values() for n in node.unreached}, {None})

    def test_a_client_is_led_to_the_node_that_has_the_mission(self):
        for i, mission in enumerate(MISSIONS[:9]):
            self.owners[mission] = NAMES[i % 3]
            self.assertEqual(self.client.get_mission(mission).owner, NAMES[i % 3])
            self.owners[mission] = NAMES[(i + 1) % 3]
            self.assertEqual(self.client.get_mission(mission).owner, NAMES[(i + 1) % 3])

    def watch(self, node):
        """A stream that is open at this node."""
        watch = robot_grpc.RobotServiceStub(self.client.driver.channel).WatchRobot(
            robot_pb.WatchRobotRequest(), metadata=[("x-node", node)], timeout=running.PATIENCE_S
        )
        next(watch)
        return watch

    def test_a_node_that_drains_keeps_its_streams_and_one_that_hangs_does_not(self):
        drained, hung = self.watch("n1"), self.watch("n2")
        self.nodes["n1"].ready = False
        self.await_places(lambda p: "n1" not in p.values(), "n1 gets no new calls")
        self.nodes["n2"].hangs.set()
        with self.assertRaises(grpc.RpcError) as caught:
            next(hung)
        self.assertIn(
            caught.exception.code(),
            (grpc.StatusCode.UNKNOWN, grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.INTERNAL),
        )
        self.await_places(lambda p: set(p.values()) == {"n3"}, "all go to the third")
        self.assertEqual(self.where("house", "n2"), "n3", "a name that is down is as none")
        self.assertEqual(self.nodes["n3"].unreached[-1], "n2", "and the node that is asked is told")
        self.where("house", "n3")
        self.assertEqual(self.nodes["n3"].unreached[-1], None)
        self.assertTrue(drained.is_active())
        drained.cancel()

    def test_a_call_that_no_node_has_seen_goes_to_another(self):
        self.nodes["n1"].die()
        self.assertIn(self.where("house", "n1"), ("n2", "n3"))
        for name in ("n2", "n3"):
            self.nodes[name].die()
        with self.assertRaises(grpc.RpcError) as caught:
            self.where("house")
        self.assertEqual(caught.exception.code(), grpc.StatusCode.UNAVAILABLE)
        self.assertEqual(caught.exception.details(), "the node does not answer")

    def test_clients_are_told_that_nobody_is_ready(self):
        for node in self.nodes.values():
            node.ready = False

        def code():
            try:
                self.where("house")
                return None
            except grpc.RpcError as error:
                return error.code(), error.details()

        told = running.await_that(code, "nobody answers")
        self.assertEqual(told, (grpc.StatusCode.UNAVAILABLE, "no node is ready"))
        self.nodes["n1"].ready = True
        self.assertEqual(self.client.get_mission("house").owner, "n1", "it was asked again")


if __name__ == "__main__":
    unittest.main()
