# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What all fault tests stand on: a durable server that can be killed and started again, their
arguments, and a way to do many things two at a time.

Every test takes --long, for the sizes that take hours, and --seed; without, it has the size for
continuous integration and a seed of its own, which it prints.
"""

import argparse
import concurrent.futures
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import grpc
from google.rpc import error_details_pb2, status_pb2

import running

BUILD_DIR = running.BUILD_DIR
PATIENCE_S = running.PATIENCE_S
SHIM = BUILD_DIR / "lib/libplumescout_io_shim.so"
EXIT_BY_FAULT = 86  # of the shim
# A server of tests: no rates, and no clock that observations could be ahead of.
SETTINGS = (
    "observe.http_listen=127.0.0.1:0",
    "limits.max_scans_per_s=0",
    "limits.max_gas_readings_per_s=0",
    "limits.max_ingest_bytes_per_s=0",
    "limits.max_plans_per_s=0",
    "connection.self_probe_period_s=0",
    "planning.default_budget_s=0.2",
)
# What a call may end with when its server dies, and what an honest client then tries again.
LINK_CODES = frozenset(
    {
        grpc.StatusCode.UNAVAILABLE,
        grpc.StatusCode.DEADLINE_EXCEEDED,
        grpc.StatusCode.CANCELLED,
        grpc.StatusCode.INTERNAL,  # a stream reset in the middle
        grpc.StatusCode.UNKNOWN,  # a stream that ended without a status
    }
)

arguments = argparse.Namespace(long=False, seed=0)


def main():
    """Runs the tests of the program, as unittest.main does, with the arguments above."""
    parser = argparse.ArgumentParser(description=sys.modules["__main__"].__doc__)
    parser.add_argument("--long", action="store_true", help="sizes that take hours")
    parser.add_argument("--seed", type=int, default=int(time.time()) % 1_000_000)
    _, rest = parser.parse_known_args(namespace=arguments)
    print(f"--seed {arguments.seed}{' --long' if arguments.long else ''}", flush=True)
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)


def size(ci, long):
    return long if arguments.long else ci


def random_of(*words):
    """Random numbers of their own for each part of a test, whatever the others draw."""
    return random.Random(f"{arguments.seed} {words}")


def folder_of(test, parent=None):
    """A folder that goes with the test; it is kept if the test fails and PLUMESCOUT_KEEP is set."""
    path = pathlib.Path(tempfile.mkdtemp(prefix="plumescout-faults-", dir=parent)).resolve()
    if "PLUMESCOUT_KEEP" not in os.environ:
        test.addCleanup(shutil.rmtree, path, ignore_errors=True)
    return path


def two_at_a_time(work, items):
    """[work(item) ...] on two threads; the first exception of any ends it."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        futures = [pool.submit(work, item) for item in items]
        done, _ = concurrent.futures.wait(futures, return_when=concurrent.futures.FIRST_EXCEPTION)
        for future in done:
            if future.exception() is not None:
                pool.shutdown(wait=True, cancel_futures=True)
                raise future.exception()
        return [future.result() for future in futures]


def channel_to(target):
    """A channel of its own connection. One that could not connect waits before it tries again: who
    is in a hurry makes another."""
    return grpc.insecure_channel(
        target,
        options=[
            ("grpc.use_local_subchannel_pool", 1),
            ("grpc.enable_retries", 0),
            ("grpc.max_receive_message_length", 64 << 20),
        ],
    )


def reason_of(error):
    """The reason of a grpc.RpcError, or ''."""
    details = status_pb2.Status()
    for key, value in error.trailing_metadata() or ():
        if key == "grpc-status-details-bin":
            details.ParseFromString(value)
    info = error_details_pb2.ErrorInfo()
    for detail in details.details:
        detail.Unpack(info)
    return info.reason


class DidNotStart(Exception):
    """The server ended before it listened. code: how; says_why: it failed in good order, and named
    its data folder or a file in it."""

    def __init__(self, code, log, data):
        super().__init__(f"exit code {code}: {log[-2000:]}")
        self.code = code
        self.says_why = code == 1 and str(data) in log


class Server:
    """A plumescout-server on one folder and one port, for as many lives as a test wants.

    folder: for its log and, unless `data` says otherwise, its data. environment: of its process.
    config: a file of options, for those that nothing else sets."""

    def __init__(
        self,
        folder,
        *settings,
        data=None,
        environment=None,
        port=None,
        store="sqlite",
        config=None,
    ):
        self.folder = pathlib.Path(folder)
        self.data = pathlib.Path(data or self.folder / "data")
        self.port = port or running.free_port()
        self.target = f"127.0.0.1:{self.port}"
        self.metrics = None  # host:port
        self.process = None
        self.environment = dict(environment or {})
        self._store = store
        self._config = ["--config", config] if config else []
        self._settings = (*SETTINGS, *settings)
        self._log = self.folder / "server.log"
        self._reader = None

    def start(self):
        """Returns once it listens. DidNotStart if it ends before."""
        command = [BUILD_DIR / "bin/plumescout-server", *self._config, "--listen", self.target]
        command += ["--store", self._store]
        if self._store != "none":
            command += ["--data", self.data]
        for setting in self._settings:
            command += ["--set", setting]
        with open(self._log, "ab") as log:
            begin = log.tell()
            self.process = subprocess.Popen(
                command,
                stdout=subprocess.PIPE,
                stderr=log,
                stdin=subprocess.DEVNULL,
                text=True,
                env=dict(os.environ, **self.environment),
            )
        for line in self.process.stdout:
            if line.startswith("metrics on "):
                self.metrics = line.split()[-1]
            if line.startswith("listening on "):
                self._reader = threading.Thread(target=self._drain_output)
                self._reader.start()
                return self
        code = self.process.wait(timeout=PATIENCE_S)
        self.process.stdout.close()
        raise DidNotStart(code, self.log()[begin:], self.data)

    def _drain_output(self):
        for _ in self.process.stdout:
            pass

    def log(self):
        return self._log.read_text(errors="replace") if self._log.exists() else ""

    def alive(self):
        return self.process is not None and self.process.poll() is None

    def kill(self):
        """SIGKILL, if it still runs. Returns its exit code: negative for a signal."""
        return self._end(signal.SIGKILL)

    def stop(self):
        """SIGTERM; it drains."""
        return self._end(signal.SIGTERM)

    def _end(self, number):
        if self.process is None:
            return None
        if self.process.poll() is None:
            self.process.send_signal(number)
        try:
            code = self.process.wait(timeout=PATIENCE_S)
        finally:
            if self.process.poll() is None:
                self.process.kill()
        if self._reader is not None:
            self._reader.join()
            self._reader = None
        self.process.stdout.close()
        self.process = None
        return code

    def rss_bytes(self):
        return running.rss_bytes(self.process.pid)

    def descriptors(self):
        return len(os.listdir(f"/proc/{self.process.pid}/fd"))

    def threads(self):
        return len(os.listdir(f"/proc/{self.process.pid}/task"))


def copy_of(data, where):
    """A copy of a data folder as a crash left it, for others to look into."""
    if where.exists():
        shutil.rmtree(where)
    shutil.copytree(data, where)
    return where
