# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Programs that tests of the deployment run: the server, the front, an authority."""

import errno
import os
import pathlib
import random
import socket
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD_DIR = pathlib.Path(os.environ["PLUMESCOUT_BUILD_DIR"])
SERVER_PORTS = (10_000, 32_000)
PATIENCE_S = 60.0  # far beyond what anything takes, on any machine


def await_that(condition, what, patience_s=PATIENCE_S):
    """Returns what condition() gives once it is true."""
    deadline = time.monotonic() + patience_s
    while time.monotonic() < deadline:
        result = condition()
        if result:
            return result
        time.sleep(0.01)
    raise AssertionError(f"not within {patience_s} s: {what}")


def make_certificate(folder, *arguments):
    subprocess.run([ROOT / "scripts/certs", folder, *arguments], check=True)


def free_port():
    """Of those below the ones that the system gives to whoever connects: it stays free while a
    server that has it is down."""
    while True:
        port = random.SystemRandom().randrange(*SERVER_PORTS)
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", port))
                return port
            except OSError as error:
                if error.errno != errno.EADDRINUSE:
                    raise


class Server:
    """A plumescout-server on a loopback port. descriptors: its soft and hard limit."""

    def __init__(self, *settings, listen="127.0.0.1:0", descriptors=None):
        command = [BUILD_DIR / "bin/plumescout-server", "--listen", listen, "--store", "none"]
        for setting in settings:
            command += ["--set", setting]
        if descriptors:  # not by preexec_fn: what forks then aborts in gRPC's threads at times
            command[:0] = ["prlimit", "--nofile={}:{}".format(*descriptors)]
        self.process = subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        for line in self.process.stdout:  # which may name the address of its metrics, too
            if line.startswith("listening on "):
                self.target = line.split()[-1]
                return
        raise RuntimeError("the server did not start")

    def rss_bytes(self):
        return rss_bytes(self.process.pid)

    def stop(self):
        self.process.terminate()
        self.process.wait(timeout=PATIENCE_S)
        self.process.stdout.close()


class Front:
    """HAProxy with the shipped configuration on a loopback port, before a server."""

    def __init__(self, folder, server_target):
        self.port = free_port()
        environment = dict(
            os.environ,
            PLUMESCOUT_FRONT_BIND=f"127.0.0.1:{self.port}",
            PLUMESCOUT_FRONT_CERTIFICATE=str(folder / "front.crt"),
            PLUMESCOUT_FRONT_CLIENT_CA=str(folder / "ca.crt"),
            PLUMESCOUT_SERVER=server_target,
        )
        self.process = subprocess.Popen(
            [os.environ["PLUMESCOUT_HAPROXY"], "-db", "-f", ROOT / "deploy/haproxy/haproxy.cfg"],
            env=environment,
            stdout=subprocess.DEVNULL,
        )
        self.target = f"127.0.0.1:{self.port}"
        await_that(self._answers, "the front listens")

    def _answers(self):
        if self.process.poll() is not None:
            raise RuntimeError("the front did not start")
        try:
            # From an address of its own, for the front counts connections by address.
            socket.create_connection(
                ("127.0.0.1", self.port), source_address=("127.0.0.9", 0)
            ).close()
            return True
        except OSError:
            return False

    def rss_bytes(self):
        return rss_bytes(self.process.pid)

    def stop(self):
        self.process.terminate()
        self.process.wait(timeout=PATIENCE_S)


def rss_bytes(pid):
    pages = int(pathlib.Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")
