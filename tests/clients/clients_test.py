# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the scenario of the clients with the runners given, each against a server of its own.

clients_test.py [--cluster] [RUNNER ARGUMENT ...]: see README.md. Without a runner, the one of Python
alone.
"""

import hashlib
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import urllib.error
import urllib.request

import bed
import cluster_parts
import plumescout
import postgres
import running
from google.protobuf import descriptor_pb2

HERE = pathlib.Path(__file__).resolve().parent
SCENARIO = HERE / "scenario.json"
IN_CLUSTER = sys.argv[1:2] == ["--cluster"]
RUNNER = sys.argv[2:] if IN_CLUSTER else sys.argv[1:]
PYTHON_RUNNER = [sys.executable, str(HERE / "run_python.py")]
# Not of a mission, so they say something of the one node that they come to.
OF_ONE_NODE = ("list_missions", "drain_server")
MISSION = "room"  # whose server is killed


def _passes_the_router(step):
    """False: it says something of one node, or is refused in the middle of what it sends. HAProxy 2.6 then
    resets the stream behind the status, and grpcio says CANCELLED, with the true reason."""
    refused_early = step["do"] == "import_mission" and "MISSION_EXISTS" in str(step.get("error"))
    return step["do"] not in OF_ONE_NODE and not refused_early


def rpcs():
    """The RPCs of the services in the tree, as kinds of steps."""
    proto = HERE.parents[1] / "proto"
    with tempfile.NamedTemporaryFile() as file:
        sources = sorted(str(path) for path in proto.glob("plumescout/v1/*_service.proto"))
        subprocess.run(
            ["protoc", f"-I{proto}", f"--descriptor_set_out={file.name}", *sources], check=True
        )
        files = descriptor_pb2.FileDescriptorSet.FromString(file.read())
    return {
        re.sub(r"(?<!^)(?=[A-Z])", "_", method.name).lower()
        for source in files.file
        for service in source.service
        for method in service.method
    }


def run(runner):
    """The lines that a runner prints, parsed, of a run against a new server; and the files of its
    exports with what the server gives then, each by its SHA-256."""
    with tempfile.TemporaryDirectory(prefix="plumescout-clients-") as folder:
        folder = pathlib.Path(folder)
        work = folder / "work"
        work.mkdir()
        (work / "damaged.journal").write_bytes(b"this was never a mission")
        server = bed.Server(folder)
        server.start()
        process = subprocess.Popen(
            [*runner, server.target, str(SCENARIO)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            cwd=work,
        )
        try:
            lines = list(_lines(process, lambda: (server.kill(), _start_again(server))))
            server.kill()
            _start_again(server)
            return lines, list(_exports(server, work))
        finally:
            process.kill()
            process.communicate()
            server.kill()


class Cluster:
    """Two servers on one PostgreSQL behind the shipped router."""

    def __init__(self, folder):
        folder.chmod(0o755)  # PostgreSQL is another user
        self._database = postgres.Postgres(folder / "postgres", running.free_port())
        running.await_that(self._database.make_database, "PostgreSQL answers")
        address = f"127.0.0.1:{self._database.port}"
        self._nodes = [
            cluster_parts.Node(name, folder, self._database.url_by, address, cuttable=False)
            for name in ("n1", "n2")
        ]
        self._router = cluster_parts.Router(self._nodes, folder)
        running.await_that(self._router.answers, "the router leads to a node")
        self.target = self._router.target

    def _owner(self):
        rows = self._database.ask(cluster_parts.OWNERS)
        names = [name for key, name, *_ in rows if key.rsplit("/", 1)[-1] == MISSION]
        return next((node for node in self._nodes if node.name in names), None)

    def kill_owner(self):
        """It does not come back: whoever calls for the mission is served by the other."""
        running.await_that(self._owner, f"a server has {MISSION}").server.kill()

    def stop(self):
        self._router.stop()
        for node in self._nodes:
            node.stop()
        self._database.stop()


def run_in_cluster(runner, steps):
    """The lines that a runner prints, parsed; at the step `restart` the owner of its mission dies."""
    with tempfile.TemporaryDirectory(prefix="plumescout-clients-") as folder:
        folder = pathlib.Path(folder).resolve()
        work = folder / "work"
        work.mkdir()
        (work / "damaged.journal").write_bytes(b"this was never a mission")
        scenario = json.loads(SCENARIO.read_text())
        (folder / "scenario.json").write_text(json.dumps({**scenario, "steps": steps}))
        cluster = Cluster(folder)
        process = subprocess.Popen(
            [*runner, cluster.target, str(folder / "scenario.json")],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            cwd=work,
        )
        try:
            return list(_lines(process, cluster.kill_owner))
        finally:
            process.kill()
            process.communicate()
            cluster.stop()


def _is_ready(server):
    try:
        return urllib.request.urlopen(f"http://{server.metrics}/readyz").status == 200
    except urllib.error.HTTPError:
        return False


def _start_again(server):
    server.start()
    while not _is_ready(server):  # it has missions to recover
        pass


def _exports(server, work):
    with plumescout.Client(server.target) as client:
        for step in json.loads(SCENARIO.read_text())["steps"]:
            if step["do"] != "export_mission":
                continue
            file = work / step["with"]["file"]
            again = work / "again"
            mcap = step["with"].get("format") == "MCAP"
            client.export_mission(step["with"]["mission"], again, mcap=mcap)
            yield file.name, *(hashlib.sha256(f.read_bytes()).hexdigest() for f in (file, again))


def _lines(process, restart):
    for line in process.stdout:
        told = json.loads(line)
        yield told
        if told["do"] == "restart":
            restart()
            process.stdin.write("restarted\n")
            process.stdin.flush()
    code = process.wait(timeout=bed.PATIENCE_S)
    if code != 0:
        raise AssertionError(f"{process.args[0]} ended with {code}")


class ScenarioTest(unittest.TestCase):
    maxDiff = None

    def check(self, lines):
        """Whether each step brought what the scenario says."""
        for number, (step, told) in enumerate(zip(self.steps, lines), start=1):
            with self.subTest(step=number, do=step["do"], name=step.get("name", "")):
                self.assertEqual(told["do"], step["do"])
                kind = "error" if "error" in step else "result"
                self.assertIn(kind, told, told)
                expected = step.get("error", step.get("expect", {}))
                self.assertEqual({key: told[kind].get(key) for key in expected}, expected)
        self.assertEqual(len(lines), len(self.steps), "steps that were done")


@unittest.skipUnless(IN_CLUSTER, "without --cluster")
class ClusterTest(ScenarioTest):
    def test_the_client_gets_what_the_scenario_says_while_the_missions_server_is_killed(self):
        steps = json.loads(SCENARIO.read_text())["steps"]
        self.steps = list(filter(_passes_the_router, steps))
        self.check(run_in_cluster(RUNNER or PYTHON_RUNNER, self.steps))


@unittest.skipIf(IN_CLUSTER, "with --cluster")
class ClientsTest(ScenarioTest):
    @classmethod
    def setUpClass(cls):
        cls.steps = json.loads(SCENARIO.read_text())["steps"]
        cls.python, cls.python_exports = run(PYTHON_RUNNER)

    def check_exports(self, exports):
        self.assertEqual([name for name, _, _ in exports], ["room.journal", "room.mcap"])
        for name, of_runner, of_server in exports:
            self.assertEqual(of_runner, of_server, name)

    def test_every_rpc_has_a_step(self):
        kinds = {step["do"] for step in self.steps} - {"restart"}
        self.assertEqual(sorted(rpcs() - kinds), [], "RPCs that no step calls")
        self.assertEqual(sorted(kinds - rpcs()), [], "steps that are no RPC")

    def test_the_python_client_gets_what_the_scenario_says(self):
        self.check(self.python)
        self.check_exports(self.python_exports)

    def test_maps_are_the_same_to_the_byte_wherever_they_come_from(self):
        maps = {
            step.get("name", ""): told["result"]
            for step, told in zip(self.steps, self.python)
            if step["do"] == "get_map" and "result" in told
        }
        self.assertEqual(maps["the copy"], maps["the original"])
        whole = next(
            told["result"] for step, told in zip(self.steps, self.python) if step["do"] == "get_map"
        )
        self.assertEqual(maps["in parts"], whole)
        watched = next(
            told["result"]
            for step, told in zip(self.steps, self.python)
            if step["do"] == "watch_map" and "during" in step["with"]
        )
        self.assertEqual(maps["as watched"]["occupancy_sha256"], watched["occupancy_sha256"])

    @unittest.skipUnless(RUNNER, "no runner is given")
    def test_the_client_gets_what_the_scenario_says_and_python_got(self):
        lines, exports = run(RUNNER)
        self.check(lines)
        self.check_exports(exports)
        for number, (told, python) in enumerate(zip(lines, self.python), start=1):
            with self.subTest(step=number, do=python["do"]):
                self.assertEqual(told, python)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
