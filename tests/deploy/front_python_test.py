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
import threading
import time
import unittest

import grpc

import plumescout
import running
from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import mission_service_pb2_grpc as mission_grpc

MAX_CONNECTIONS_OF_A_SOURCE = 64  # as deploy/haproxy/haproxy.cfg has it
MAX_CALLS_IN_10_S = 500
MAX_OPEN_CALLS = 200  # of a certificate
FLOOD_S = 6.0
HONEST_CALL_S = 1.0  # the longest that an honest call may take beside a flood
MAX_GROWTH_BYTES = 128 << 20

DATA, HEADERS, RST_STREAM, SETTINGS = 0, 1, 3, 4
END_HEADERS = 4
CANCEL = 8


def frame(kind, flags, stream, payload):
    return struct.pack(">I", len(payload))[1:] + struct.pack(">BBI", kind, flags, stream) + payload


def literal(name_index, value):
    """A header whose name is of HPACK's static table, without Huffman codes."""
    index = bytes([name_index]) if name_index < 15 else bytes([15, name_index - 15])
    return index + bytes([len(value)]) + value


# POST, https and a method of the service; 4 is :path, 1 :authority, 31 content-type.
CALL = (
    b"\x83\x87"
    + literal(4, b"/plumescout.v1.MissionService/ListMissions")
    + literal(1, b"localhost")
    + literal(31, b"application/grpc")
    + b"\0\x02te\x08trailers"
)
PREFACE = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + frame(SETTINGS, 0, 0, b"")


def resets(first_stream, count):
    """Calls that are taken back as soon as they are made."""
    frames = []
    for stream in range(first_stream, first_stream + 2 * count, 2):
        frames.append(frame(HEADERS, END_HEADERS, stream, CALL))
        frames.append(frame(RST_STREAM, 0, stream, struct.pack(">I", CANCEL)))
    return b"".join(frames)


def half_requests(count):
    """Calls whose request is never sent to its end."""
    half = b"\0" + struct.pack(">I", 1000) + b"\0" * 500
    streams = range(1, 2 * count, 2)
    return b"".join(
        frame(HEADERS, END_HEADERS, stream, CALL) + frame(DATA, 0, stream, half)
        for stream in streams
    )


class Answers:
    """How many calls of a connection have been answered."""

    def __init__(self, link):
        self._link = link
        self._link.settimeout(0.0)
        self._bytes = b""
        self.count = 0

    def look(self):
        try:
            while chunk := self._link.recv(1 << 16):
                self._bytes += chunk
        except (BlockingIOError, ssl.SSLWantReadError):
            pass
        while len(self._bytes) >= 9:
            end = 9 + int.from_bytes(self._bytes[:3], "big")
            if len(self._bytes) < end:
                break
            self.count += self._bytes[3] == HEADERS
            self._bytes = self._bytes[end:]
        return self.count


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
            link.sendall(PREFACE + half_requests(each))
        answers = [Answers(link) for link in links]
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
        flood = Flood(lambda: self.handshake("127.0.0.3", "busy"), end)
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


class Flood:
    """Four connections at a time that open streams and reset them, as fast as they can."""

    BATCH = 200

    def __init__(self, handshake, end):
        self._handshake = handshake
        self._end = end
        self.resets = self.connections = self.refused = 0
        self._lock = threading.Lock()
        self._threads = [threading.Thread(target=self._run) for _ in range(4)]
        for thread in self._threads:
            thread.start()

    def join(self):
        for thread in self._threads:
            thread.join()

    def _add(self, **counts):
        with self._lock:
            for name, count in counts.items():
                setattr(self, name, getattr(self, name) + count)

    def _run(self):
        while time.monotonic() < self._end:
            try:
                link = self._handshake()
            except OSError:
                self._add(refused=1)
                continue
            self._add(connections=1)
            try:
                link.sendall(PREFACE)
                stream = 1
                while time.monotonic() < self._end:
                    link.sendall(resets(stream, self.BATCH))
                    self._add(resets=self.BATCH)
                    stream += 2 * self.BATCH
            except OSError:
                pass  # ended by the front: on with another
            link.close()


if __name__ == "__main__":
    unittest.main()
