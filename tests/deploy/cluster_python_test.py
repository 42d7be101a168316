# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""The production form of a cluster as it ships, but for its addresses: the front, the router, and two
servers by deploy/cluster/node.yaml on one PostgreSQL, each of which shows the others a certificate.
Clients are who their certificates say, wherever their mission is, and also after its server was killed.
"""

import pathlib
import tempfile
import unittest
import urllib.error
import urllib.request

import bed
import cluster_parts
import grpc
import plumescout
import postgres
import running

from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import mission_service_pb2_grpc as mission_grpc

NAMES = ("n1", "n2")
OWNER = (
    "SELECT n.name FROM plumescout_mission m JOIN plumescout_progress p ON p.mission = m.id "
    "JOIN plumescout_node n ON n.id = p.owner AND n.expires > clock_timestamp() "
    "WHERE encode(m.key, 'escape') LIKE '%/{mission}'"
)


class Node:
    """By the file that ships. certificates: a folder with its own and the authority's."""

    def __init__(self, name, folder, database, certificates):
        self.name, self.http_port = name, running.free_port()
        (folder / name).mkdir()
        self.server = bed.Server(
            folder / name,
            f"observe.http_listen=127.0.0.1:{self.http_port}",
            f"access.tls_certificate_file={certificates / name}.crt",
            f"access.tls_key_file={certificates / name}.key",
            f"access.client_ca_file={certificates}/ca.crt",
            f"store.node={name}",
            "store.lease_s=1",
            config=running.ROOT / "deploy/cluster/node.yaml",
            store=database.url,
        ).start()

    def is_ready(self):
        try:
            url = f"http://127.0.0.1:{self.http_port}/readyz"
            return urllib.request.urlopen(url, timeout=running.PATIENCE_S).status == 200
        except urllib.error.HTTPError:
            return False


class ClusterTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        root = pathlib.Path(folder.name).resolve()
        root.chmod(0o755)  # PostgreSQL is another user
        cls.robots, cls.cluster = root / "robots", root / "cluster"
        for made in (
            ("authority",),
            ("server", "front"),
            ("client", "alice", "operator", "acme"),
            ("client", "scout", "robot", "acme"),
        ):
            running.make_certificate(cls.robots, *made)
        for made in (
            ("authority",),
            ("client", "router", "router"),
            ("client", "olga", "admin"),
            *(("server", name, f"DNS:{name}", "IP:127.0.0.1") for name in NAMES),
        ):
            running.make_certificate(cls.cluster, *made)
        cls.database = postgres.Postgres(root / "postgres", running.free_port())
        cls.addClassCleanup(cls.database.stop)
        running.await_that(cls.database.make_database, "PostgreSQL answers")
        cls.nodes = []
        for name in NAMES:
            node = Node(name, root, cls.database, cls.cluster)
            cls.addClassCleanup(node.server.kill)
            cls.nodes.append(node)
        for node in cls.nodes:
            running.await_that(node.is_ready, f"{node.name} is ready")
        cls.router = cluster_parts.Router(cls.nodes, root, certificates=cls.cluster)
        cls.addClassCleanup(cls.router.stop)
        cls.front = running.Front(cls.robots, cls.router.target)
        cls.addClassCleanup(cls.front.stop)

    def client(self, name, target=None, folder=None, timeout_s=running.PATIENCE_S):
        folder = folder or self.robots
        client = plumescout.Client(
            target or self.front.target,
            timeout_s=timeout_s,
            tls_ca=(self.robots if target is None else self.cluster) / "ca.crt",
            tls_cert=folder / f"{name}.crt" if name else None,
            tls_key=folder / f"{name}.key" if name else None,
        )
        self.addCleanup(client.close)
        return client

    def assert_refused(self, code, call, *arguments):
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            call(*arguments)
        self.assertEqual(caught.exception.code, code)

    def owner(self, mission):
        return running.await_that(
            lambda: self.database.ask(OWNER.format(mission=mission)), f"a node has {mission}"
        )[0][0]

    def test_clients_are_who_the_front_says_on_every_node(self):
        alice, scout = self.client("alice"), self.client("scout")
        owners = set()
        for mission in (f"house-{i}" for i in range(8)):
            self.assertEqual(alice.create_mission(mission).owner, "alice")
            scout.register(mission, "scout")
            self.assert_refused(
                grpc.StatusCode.PERMISSION_DENIED, scout.register, mission, "rover"
            )
            owners.add(self.owner(mission))
            if owners == set(NAMES):
                break  # a node takes eight missions
        self.assertEqual(owners, set(NAMES))
        self.assert_refused(grpc.StatusCode.PERMISSION_DENIED, scout.create_mission, "attic")

    def test_nodes_believe_the_router_and_nobody_else(self):
        node = self.nodes[0].server
        olga = self.client("olga", node.target, self.cluster)
        olga.list_missions()  # an operator of the cluster, as herself
        request = mission_pb.ListMissionsRequest()
        with self.assertRaises(grpc.RpcError) as caught:
            mission_grpc.MissionServiceStub(olga.driver.channel).ListMissions(
                request, metadata=[("x-plumescout-subject", "CN=alice,OU=operator,O=acme")]
            )
        self.assertEqual(caught.exception.code(), grpc.StatusCode.UNAUTHENTICATED)
        # What the router's certificate says of itself gives no rights.
        self.assert_refused(
            grpc.StatusCode.UNAUTHENTICATED,
            self.client("router", node.target, self.cluster).list_missions,
        )
        for name, folder in ((None, None), ("alice", self.robots)):
            with self.assertRaises(plumescout.PlumeScoutError, msg=name):
                self.client(name, node.target, folder, timeout_s=1.0).list_missions()

    def test_the_router_believes_no_node_without_the_certificate_of_its_name(self):
        strangers = self.robots.parent / "strangers"
        running.make_certificate(strangers, "authority")
        running.make_certificate(strangers, "client", "router", "router")
        routers = {"another authority": (self.nodes, strangers)}
        routers["each in the other's place"] = (self.nodes[::-1], self.cluster)
        for what, (nodes, certificates) in routers.items():
            folder = self.robots.parent / what.replace(" ", "-").replace("'", "")
            folder.mkdir()
            router = cluster_parts.Router(nodes, folder, certificates=certificates)
            self.addCleanup(router.stop)
            with self.subTest(what), plumescout.Client(router.target) as client:
                missions = mission_grpc.MissionServiceStub(client.driver.channel)
                with self.assertRaises(grpc.RpcError) as caught:  # once: clients come again
                    missions.ListMissions(
                        mission_pb.ListMissionsRequest(),
                        timeout=running.PATIENCE_S,
                        wait_for_ready=True,
                    )
                self.assertEqual(caught.exception.code(), grpc.StatusCode.UNAVAILABLE)

    def test_a_killed_server_takes_no_identity_with_it(self):
        alice, scout = self.client("alice"), self.client("scout")
        alice.create_mission("cellar")
        session = scout.register("cellar", "scout")
        was = self.owner("cellar")
        node = next(node for node in self.nodes if node.name == was)
        node.server.kill()
        self.assertEqual(alice.get_mission("cellar").owner, "alice")
        self.assertNotEqual(self.owner("cellar"), was)
        session.release()  # under the lease that the other server gave
        node.server.start()
        running.await_that(node.is_ready, "it is back")


if __name__ == "__main__":
    unittest.main()
