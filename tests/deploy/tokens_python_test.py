# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Bearer tokens from their making to their end, with the server that they are for."""

import concurrent.futures
import contextlib
import io
import os
import pathlib
import subprocess
import tempfile
import unittest

import grpc

import plumescout
from plumescout import tokens
import running


class TokensTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.file = self.folder / "tokens"

    def start_server(self):
        server = running.Server(f"access.tokens_file={self.file}")
        self.addCleanup(server.stop)
        return server

    def client(self, server, secret):
        token_file = self.folder / "secret"
        token_file.write_text(f"{secret}\n")
        client = plumescout.Client(
            server.target, timeout_s=running.PATIENCE_S, token_file=token_file
        )
        self.addCleanup(client.close)
        return client

    def assert_refused(self, code, call, *arguments):
        with self.assertRaises(plumescout.PlumeScoutError) as caught:
            call(*arguments)
        self.assertEqual(caught.exception.code, code)

    def is_unknown(self, client):
        try:
            client.list_missions()
            return False
        except plumescout.PlumeScoutError as error:
            self.assertEqual(error.code, grpc.StatusCode.UNAUTHENTICATED)
            return True

    def test_a_token_lets_in_until_it_is_revoked(self):
        alice = tokens.create(self.file, "alice", "operator", "acme", days=1)
        server = self.start_server()
        client = self.client(server, alice)
        client.create_mission("house")
        robot = tokens.create(self.file, "scout", "robot", "acme")
        self.assertEqual(tokens.revoke(self.file, "alice"), 1)
        running.await_that(lambda: self.is_unknown(client), "the server hears of it")

        client = self.client(server, robot)
        self.assertEqual(client.list_missions(), ["house"])
        self.assert_refused(grpc.StatusCode.PERMISSION_DENIED, client.create_mission, "attic")
        client.register("house", "scout")
        self.assert_refused(grpc.StatusCode.PERMISSION_DENIED, client.register, "house", "rover")

    def test_other_tenants_see_nothing(self):
        alice = tokens.create(self.file, "alice", "operator", "acme")
        bob = tokens.create(self.file, "bob", "operator", "other")
        server = self.start_server()
        self.client(server, alice).create_mission("house")
        client = self.client(server, bob)
        self.assertEqual(client.list_missions(), [])
        self.assert_refused(grpc.StatusCode.NOT_FOUND, client.get_map, "house")

    def test_wrong_expired_and_missing_tokens_are_refused(self):
        late = tokens.create(self.file, "late", "operator", days=1e-9)
        server = self.start_server()
        for secret in (late, late + "x", "ps_", "none"):
            client = self.client(server, secret)
            self.assert_refused(grpc.StatusCode.UNAUTHENTICATED, client.list_missions)
        with plumescout.Client(server.target, timeout_s=running.PATIENCE_S) as client:
            self.assert_refused(grpc.StatusCode.UNAUTHENTICATED, client.list_missions)

    def test_the_file_tells_who_has_tokens_and_no_secret(self):
        secrets = [tokens.create(self.file, "scout", "robot") for _ in range(2)]
        self.file.write_text("# ours\n" + self.file.read_text())
        first, second = tokens.list_tokens(self.file)
        self.assertEqual((first.name, first.role, first.tenant, first.expiry), ("scout", "robot", "", "never"))
        self.assertNotEqual(first.id, second.id)
        for secret in secrets:
            self.assertNotIn(secret, self.file.read_text())
        self.assertEqual(tokens.revoke(self.file, first.id), 1)
        self.assertEqual(tokens.list_tokens(self.file), [second])
        self.assertEqual(tokens.revoke(self.file, "nobody"), 0)
        self.assertTrue(self.file.read_text().startswith("# ours\n"))

    def test_words_that_the_server_would_refuse_are_refused(self):
        for arguments in (
            ("a b", "viewer"),
            ("", "viewer"),
            ("a", "king"),
            ("Scout", "robot"),
            ("a", "viewer", "-"),
            ("a", "viewer", "x y"),
            ("a", "viewer", "x/y"),
            ("a", "viewer", "", -1),
        ):
            with self.assertRaises(ValueError, msg=arguments):
                tokens.create(self.file, *arguments)
        self.assertFalse(self.file.exists())

    def test_writers_at_the_same_time_lose_nothing(self):
        names = [f"robot-{i}" for i in range(20)]
        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            list(pool.map(lambda name: tokens.create(self.file, name, "robot"), names))
        listed = tokens.list_tokens(self.file)
        self.assertEqual(sorted(t.name for t in listed), sorted(names))
        self.assertEqual(os.listdir(self.folder).count("tokens"), 1)

    def test_the_program_does_the_same(self):
        def run(*arguments):
            output = io.StringIO()
            with contextlib.redirect_stdout(output), contextlib.redirect_stderr(io.StringIO()):
                code = tokens.main([str(a) for a in arguments])
            return code, output.getvalue()

        code, secret = run("create", self.file, "alice", "--role", "admin", "--days", "30")
        self.assertEqual((code, secret[:3]), (0, "ps_"))
        code, listed = run("list", self.file)
        self.assertIn(" alice admin - 20", listed)
        self.assertEqual(run("revoke", self.file, "alice"), (0, ""))
        self.assertEqual(run("revoke", self.file, "alice"), (1, ""))

    def test_a_server_with_a_spoilt_file_does_not_start(self):
        self.file.write_text("rubbish\n")
        result = subprocess.run(
            [
                running.BUILD_DIR / "bin/plumescout-server",
                "--listen",
                "127.0.0.1:0",
                "--store",
                "none",
            ]
            + ["--set", f"access.tokens_file={self.file}"],
            capture_output=True,
            text=True,
            timeout=running.PATIENCE_S,
        )
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("tokens:1: must be HASH NAME ROLE TENANT EXPIRY", result.stderr)


if __name__ == "__main__":
    unittest.main()
