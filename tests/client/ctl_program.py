# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""plumescoutctl and the built server as processes."""

import contextlib
import os
import pathlib
import signal
import socket
import subprocess
import time

BUILD_DIR = pathlib.Path(os.environ["PLUMESCOUT_BUILD_DIR"])
PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "client/python/plumescoutctl"
PATIENCE_S = 60
# Runs plumescoutctl, and interrupts it when so many threads are being made.
_INTERRUPTED = """
import os, signal, sys, threading
from plumescout.ctl.main import main

left, make = int(sys.argv.pop(1)), threading.Thread.__init__

def interrupt_and_make(*args, **kwargs):
    global left
    left -= 1
    if left == 0:
        os.kill(os.getpid(), signal.SIGINT)
    make(*args, **kwargs)

threading.Thread.__init__ = interrupt_and_make
sys.exit(main())
"""


def start_server(*options, store="none"):
    """The process, and where it listens. store: how it keeps missions."""
    options = ("--store", store, *options)
    server = subprocess.Popen(
        [BUILD_DIR / "bin/plumescout-server", "--listen", "127.0.0.1:0"]
        + ["--set", "store.engine=none", *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    for line in server.stdout:
        if line.startswith("listening on "):
            return server, line.split()[-1]
    raise RuntimeError("the server did not start")


def stop_server(server):
    server.send_signal(signal.SIGTERM)
    server.wait(timeout=PATIENCE_S)
    server.stdout.close()


@contextlib.contextmanager
def silent_server():
    """A socket that takes connections and never answers, and where it listens."""
    with socket.create_server(("127.0.0.1", 0)) as silent:
        silent.settimeout(PATIENCE_S)
        yield silent, f"127.0.0.1:{silent.getsockname()[1]}"


def wait_until(condition, what):
    end_s = time.monotonic() + PATIENCE_S
    while not condition():
        if time.monotonic() > end_s:
            raise AssertionError(f"{what} within {PATIENCE_S} s")
        time.sleep(0.05)


def start_ctl(*arguments, target):
    """The process of the program, which goes on."""
    return subprocess.Popen(
        ["/usr/bin/python3", PROGRAM, *arguments, "--timeout", str(PATIENCE_S)],
        env=os.environ | {"PLUMESCOUT_SERVER": target},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def interrupt(run):
    """Its exit code, and what it says on standard error."""
    run.send_signal(signal.SIGINT)
    try:
        said = run.communicate(timeout=PATIENCE_S)[1]
    finally:
        run.kill()
    return run.returncode, said


def interrupted_ctl(threads, *arguments):
    """The program, done: it was interrupted when it was about to make so many threads."""
    return subprocess.run(
        ["/usr/bin/python3", "-c", _INTERRUPTED, str(threads), *arguments],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
    )
