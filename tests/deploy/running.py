# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Programs that tests of the deployment run: the server, the front, an authority."""

import errno
import os
import pathlib
import random
import socket
import subprocess
import sys
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


def enter_network_of_its_own():
    """Begins the program anew in a network namespace with loopback alone, where nobody else is.
    Where the machine does not let it, it says so, and goes on where it is."""
    mark = "PLUMESCOUT_TEST_OWN_NETWORK"
    if os.environ.get(mark):
        return
    enter = ["unshare", "--net"] if os.geteuid() == 0 else ["unshare", "--map-root-user", "--net"]
    loopback = "ip link set lo up multicast on"
    try:
        subprocess.run([*enter, "sh", "-c", loopback], check=True, capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError) as error:
        why = getattr(error, "stderr", None) or error
        print(f"no network namespace of its own, so on loopback: {why}", file=sys.stderr)
        return
    print("in a network namespace of its own", file=sys.stderr)
    command = ["sh", "-c", f'{loopback} && exec "$@"', "sh", sys.executable, *sys.argv]
    os.execvpe(enter[0], [*enter, *command], dict(os.environ, **{mark: "1"}))


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
    """HAProxy with the shipped configuration on loopback ports, before a server, and before its
    console where that has an address."""

    def __init__(self, folder, server_target, console="", connections=2000):
        self.port = free_port()
        self.console_port = free_port()
        configurations = ["haproxy.cfg"] + (["console.cfg"] if console else [])
        environment = dict(
            os.environ,
            PLUMESCOUT_FRONT_BIND=f"127.0.0.1:{self.port}",
            PLUMESCOUT_FRONT_CERTIFICATE=str(folder / "front.crt"),
            PLUMESCOUT_FRONT_CLIENT_CA=str(folder / "ca.crt"),
            PLUMESCOUT_SERVER=server_target,
            PLUMESCOUT_CONSOLE_BIND=f"127.0.0.1:{self.console_port}",
            PLUMESCOUT_CONSOLE=console,
            PLUMESCOUT_FRONT_CONNECTIONS=str(connections),
        )
        self.process = subprocess.Popen(
            [
                os.environ["PLUMESCOUT_HAPROXY"],
                "-db",
                *(part for name in configurations for part in ("-f", ROOT / "deploy/haproxy" / name)),
            ],
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
