# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""The shipped HAProxy front before a server: who gets in, as whom, and what floods come to.

Floods come from addresses of their own, for the front counts by address.
"""

import http.client
import pathlib
import socket
import ssl
import struct
import tempfile
import time
import unittest

import grpc

import plumescout
import raw_http2
import running
from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import mission_service_pb2_grpc as mission_grpc

MAX_CONNECTIONS_OF_A_SOURCE = 64  # as deploy/haproxy/haproxy.cfg has it
MAX_CALLS_IN_10_S = 500
MAX_OPEN_CALLS = 200  # of a certificate
FLOOD_S = 6.0
HONEST_CALL_S = 1.0  # the longest that an honest call may take beside a flood
MAX_GROWTH_BYTES = 128 << 20


class FrontTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.strangers = cls.folder / "strangers"
        for made in (
            ("authority",),
            ("server", "front"),
            ("client", "alice", "operator", "acme"),
            ("client", "scout", "robot", "acme"),
            ("client", "busy", "viewer", "acme"),
            ("client", "holder", "viewer", "acme"),
            ("client", "norole", "gardener", "acme"),
            ("client", "late", "operator", "acme", "--days", "-1"),
        ):
            running.make_certificate(cls.folder, *made)
        running.make_certificate(cls.strangers, "authority")
        running.make_certificate(cls.strangers, "client", "alice", "operator", "acme")
        console = f"127.0.0.1:{running.free_port()}"
        cls.server = running.Server("access.trusted_front=loopback", f"console.listen={console}")
        cls.addClassCleanup(cls.server.stop)
        cls.front = running.Front(cls.folder, cls.server.target, console)
        cls.addClassCleanup(cls.front.stop)

    def client(self, name, folder=None, timeout_s=running.PATIENCE_S):
        folder = folder or self.folder
        client = plumescout.Client(
            self.front.target,
            timeout_s=timeout_s,
            tls_ca=self.folder / "ca.crt",
            tls_cert=folder / f"{name}.crt" if name else None,
            tls_key=folder / f"{name}.key" if name else None,
        )
        self.addCleanup(client.close)
        return client

    def connect(self, source, front=None, timeout_s=5.0):
        port = (front or self.front).port
        return socket.create_connection(
            ("127.0.0.1", port), source_address=(source, 0), timeout=timeout_s
        )

    def handshake(self, source, name="alice", versions=(), **to):
        context = ssl.create_default_context(cafile=self.folder / "ca.crt")
        if name:
            context.load_cert_chain(self.folder / f"{name}.crt", self.folder / f"{name}.key")
        context.set_alpn_protocols(["h2"])
        if versions:
            context.set_ciphers("DEFAULT@SECLEVEL=0")  # else this side would not speak old ones
            context.minimum_version, context.maximum_version = versions
        link = context.wrap_socket(
            self.connect(source, **to), server_hostname="localhost", do_handshake_on_connect=False
        )
        try:
            link.do_handshake()
        except OSError:
            link.close()
            raise
        return link

    def assert_refused(self, code, call, *arguments):
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            call(*arguments)
        self.assertEqual(caught.exception.code, code)

    def owner_of(self, client, mission):
        return client.get_mission(mission).owner

    def test_a_certificate_says_who_calls(self):
        alice = self.client("alice")
        alice.create_mission("house")
        self.assertEqual(self.owner_of(alice, "house"), "alice")
        scout = self.client("scout")
        scout.register("house", "scout")
        self.assert_refused(grpc.StatusCode.PERMISSION_DENIED, scout.register, "house", "rover")
        self.assert_refused(grpc.StatusCode.PERMISSION_DENIED, scout.create_mission, "attic")
        self.assert_refused(
            grpc.StatusCode.UNAUTHENTICATED, self.client("norole").list_missions
        )

    def post(self, name, method, message, **headers):
        """The answer to a call that a page makes in a browser with that certificate."""
        context = ssl.create_default_context(cafile=self.folder / "ca.crt")
        if name:
            context.load_cert_chain(self.folder / f"{name}.crt", self.folder / f"{name}.key")
        link = http.client.HTTPSConnection(
            "localhost", self.front.console_port, context=context, timeout=running.PATIENCE_S
        )
        self.addCleanup(link.close)
        body = message.SerializeToString()
        link.request(
            "POST",
            f"/plumescout.v1.MissionService/{method}",
            b"\0" + struct.pack(">I", len(body)) + body,
            {"content-type": "application/grpc-web+proto", **headers},
        )
        return link.getresponse().read()

    def test_a_browser_is_who_its_certificate_says(self):
        make = mission_pb.CreateMissionRequest(mission_id="annex")
        lie = {"x-plumescout-subject": "CN=root,OU=admin"}
        self.assertIn(b"grpc-status: 7", self.post("scout", "CreateMission", make, **lie))
        self.assertIn(b"grpc-status: 0", self.post("alice", "CreateMission", make, **lie))
        self.assertEqual(self.owner_of(self.client("alice"), "annex"), "alice")
        for name in (None, "late"):
            with self.assertRaises(OSError, msg=name):
                self.post(name, "ListMissions", mission_pb.ListMissionsRequest())

    def test_streams_pass(self):
        alice = self.client("alice")
        alice.create_mission("watched")
        watch = alice.watch_map("watched")
        self.assertEqual(next(watch).revision, 0)
        watch.close()

    def test_nobody_gets_in_without_a_good_certificate(self):
        for name, folder in ((None, None), ("alice", self.strangers), ("late", None)):
            client = self.client(name, folder, timeout_s=1.0)  # it would try for ever
            with self.assertRaises(plumescout.PlumeScoutError, msg=name):
                client.list_missions()
        with plumescout.Client(self.front.target, timeout_s=1.0) as plaintext:
            with self.assertRaises(plumescout.PlumeScoutError):
                plaintext.list_missions()
        self.client("alice").list_missions()

    def test_old_versions_of_tls_are_refused(self):
        for version in (ssl.TLSVersion.TLSv1, ssl.TLSVersion.TLSv1_1):
            with self.assertRaises(ssl.SSLError) as caught:
                self.handshake("127.0.0.4", versions=(version, version))
            self.assertIn("PROTOCOL_VERSION", str(caught.exception))
        version = ssl.TLSVersion.TLSv1_2
        self.handshake("127.0.0.4", versions=(version, version)).close()

    def test_what_a_client_says_of_itself_is_not_heard(self):
        lies = [("x-plumescout-subject", "CN=root,OU=admin")]
        scout = self.client("scout")
        with self.assertRaises(grpc.RpcError) as caught:
            mission_grpc.MissionServiceStub(scout.driver.channel).CreateMission(
                mission_pb.CreateMissionRequest(mission_id="spoof"), metadata=lies * 2
            )
        self.assertEqual(caught.exception.code(), grpc.StatusCode.PERMISSION_DENIED)
        alice = self.client("alice")
        created = mission_grpc.MissionServiceStub(alice.driver.channel).CreateMission(
            mission_pb.CreateMissionRequest(mission_id="honest"), metadata=lies
        )
        self.assertEqual(created.mission.owner, "alice")

    def test_only_the_service_can_be_reached(self):
        alice = self.client("alice")
        for method in (
            "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo",
            "/grpc.channelz.v1.Channelz/GetServers",
        ):
            with self.assertRaises(grpc.RpcError) as caught:
                alice.driver.channel.unary_unary(method)(b"", timeout=running.PATIENCE_S)
            self.assertEqual(caught.exception.code(), grpc.StatusCode.UNIMPLEMENTED)  # HTTP 404
        health = alice.driver.channel.unary_unary("/grpc.health.v1.Health/Check")
        self.assertEqual(health(b"", timeout=running.PATIENCE_S), b"\x08\x01")  # SERVING

    def test_a_source_has_so_many_connections_and_no_more(self):
        source = "127.0.0.2"
        connections = []
        for _ in range(90):
            try:
                connections.append(self.connect(source))
            except ConnectionResetError:
                pass  # turned away

        def open_connections():
            count = 0
            for connection in connections:
                connection.settimeout(0.0)
                try:
                    connection.recv(1)  # the end, or a reset
                except BlockingIOError:
                    count += 1
                except OSError:
                    pass
            return count

        running.await_that(
            lambda: open_connections() <= MAX_CONNECTIONS_OF_A_SOURCE, "the rest is turned away"
        )
        self.assertGreater(open_connections(), MAX_CONNECTIONS_OF_A_SOURCE // 2)
        began = time.monotonic()
        self.client("alice").list_missions()
        self.assertLess(time.monotonic() - began, HONEST_CALL_S)
        for connection in connections:
            connection.close()

    def test_all_sources_together_have_so_many_connections_and_no_more(self):
        most = 80
        front = running.Front(self.folder, self.server.target, connections=most)
        self.addCleanup(front.stop)
        silent = [self.connect(f"127.0.0.{10 + i % 4}", front) for i in range(most - 10)]
        self.handshake("127.0.0.20", front=front, timeout_s=running.PATIENCE_S).close()
        silent += [self.connect(f"127.0.0.{10 + i % 4}", front) for i in range(20)]
        with self.assertRaises(TimeoutError):  # whoever comes first is taken first
            self.handshake("127.0.0.20", front=front, timeout_s=1.0)
        for connection in silent:
            connection.close()
        self.handshake("127.0.0.20", front=front, timeout_s=running.PATIENCE_S).close()

    def test_calls_beyond_a_rate_are_answered_by_the_front(self):
        busy = self.client("busy")
        codes = []
        for _ in range(MAX_CALLS_IN_10_S + 200):
            try:
                busy.list_missions()
                codes.append(grpc.StatusCode.OK)
            except plumescout.PlumeScoutError as error:
                codes.append(error.code)
        self.assertEqual(set(codes), {grpc.StatusCode.OK, grpc.StatusCode.RESOURCE_EXHAUSTED})
        self.assertEqual(codes[:100], [grpc.StatusCode.OK] * 100)
        self.client("alice").list_missions()

    def test_one_caller_has_so_many_open_calls_and_no_more(self):
        links = [self.handshake("127.0.0.5", "holder") for _ in range(10)]
        each = (MAX_OPEN_CALLS + 100) // len(links)
        for link in links:
            link.sendall(raw_http2.PREFACE + raw_http2.half_requests(each))
        answers = [raw_http2.Answers(link) for link in links]
        running.await_that(
            lambda: sum(answer.look() for answer in answers) >= 100, "the rest is turned away"
        )
        self.assert_refused(
            grpc.StatusCode.RESOURCE_EXHAUSTED, self.client("holder").list_missions
        )
        began = time.monotonic()
        self.client("alice").list_missions()
        self.assertLess(time.monotonic() - began, HONEST_CALL_S)
        self.assertEqual(sum(answer.look() for answer in answers), 100)
        for link in links:
            link.close()

        def is_served():
            try:
                self.client("holder").list_missions()
                return True
            except plumescout.PlumeScoutError:
                return False

        running.await_that(is_served, "who lets go is served")

    def test_resets_of_streams_harm_nobody_else(self):
        alice = self.client("alice")
        alice.create_mission("flooded")
        server_before, front_before = self.server.rss_bytes(), self.front.rss_bytes()
        end = time.monotonic() + FLOOD_S
        flood = raw_http2.Flood(lambda: self.handshake("127.0.0.3", "busy"), end)
        slowest_s, calls = 0.0, 0
        while time.monotonic() < end:
            began = time.monotonic()
            alice.list_missions()
            slowest_s = max(slowest_s, time.monotonic() - began)
            calls += 1
            time.sleep(0.05)  # an honest client's pace
        flood.join()
        grown = (self.server.rss_bytes() - server_before, self.front.rss_bytes() - front_before)
        print(
            f"\n{flood.resets} resets on {flood.connections} connections, {flood.refused} more "
            f"refused; {calls} honest calls, slowest {slowest_s * 1e3:.0f} ms; server and front "
            f"grew by {grown} bytes"
        )
        self.assertLess(slowest_s, HONEST_CALL_S)
        self.assertLess(max(grown), MAX_GROWTH_BYTES)
        self.assertGreater(flood.resets, 3000)
        with self.assertRaises(OSError):  # the flood's source is shut out
            self.handshake("127.0.0.3")


if __name__ == "__main__":
    unittest.main()
