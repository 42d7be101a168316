# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Connections that say nothing: a server has descriptors for many, and says when it has none left."""

import socket
import unittest

import plumescout
import running

EXIT_UNREACHABLE = 3


def connect(target, count):
    host, port = target.rsplit(":", 1)
    return [socket.create_connection((host, int(port))) for _ in range(count)]


def close(connections):
    for connection in connections:
        connection.close()


class DescriptorsTest(unittest.TestCase):
    def test_more_silent_connections_than_the_soft_limit_harm_nobody(self):
        server = running.Server(descriptors=(256, 2048))
        self.addCleanup(server.stop)
        connections = connect(server.target, 1100)
        self.addCleanup(close, connections)
        with plumescout.Client(server.target, timeout_s=running.PATIENCE_S) as client:
            client.create_mission("house")
            self.assertEqual(client.list_missions(), ["house"])

    def test_a_server_that_nobody_can_reach_stops_to_be_started_again(self):
        server = running.Server("connection.self_probe_period_s=0.1", descriptors=(128, 128))
        self.addCleanup(server.process.stdout.close)
        self.addCleanup(server.process.kill)
        connections = connect(server.target, 300)
        self.addCleanup(close, connections)
        self.assertEqual(server.process.wait(timeout=running.PATIENCE_S), EXIT_UNREACHABLE)

    # The listener that failed for want of descriptors stays as it is when there are some again.
    def test_a_server_that_does_not_listen_any_more_stops_to_be_started_again(self):
        server = running.Server("connection.self_probe_period_s=0.5", descriptors=(128, 128))
        self.addCleanup(server.process.stdout.close)
        self.addCleanup(server.process.kill)
        close(connect(server.target, 300))
        with self.assertRaises(plumescout.PlumeScoutError):
            with plumescout.Client(server.target, timeout_s=1.0) as client:
                client.list_missions()
        self.assertEqual(server.process.wait(timeout=running.PATIENCE_S), EXIT_UNREACHABLE)


if __name__ == "__main__":
    unittest.main()
