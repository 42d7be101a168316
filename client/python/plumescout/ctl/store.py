# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What a server has kept, looked at while none runs on it: plumescout-server does it, here."""

import os
import pathlib
import shutil
import subprocess
import sys

_BUILT = pathlib.Path(__file__).resolve().parents[4] / "build/release/bin/plumescout-server"
EXIT_USAGE = 2


def run(argv):
    """argv: what follows "store". Returns the exit code."""
    program = find_program()
    if program is None:
        print(
            "plumescoutctl: plumescout-server is not on PATH; $PLUMESCOUT_SERVER_PROGRAM may name it",
            file=sys.stderr,
        )
        return EXIT_USAGE
    return subprocess.run([program, "store", *argv]).returncode


def find_program():
    named = os.environ.get("PLUMESCOUT_SERVER_PROGRAM")
    if named:
        return named
    return shutil.which("plumescout-server") or (str(_BUILT) if _BUILT.exists() else None)
