# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A PostgreSQL of its own in a folder, on a loopback port, for as long as somebody needs it."""

import os
import pathlib
import pwd
import subprocess

USER = "plumescout"


def program(name):
    """Debian keeps each version in a folder of its own."""
    found = sorted(pathlib.Path("/usr/lib/postgresql").glob(f"*/bin/{name}"))
    if not found:
        raise RuntimeError(f"no {name} of PostgreSQL: scripts/setup --cluster")
    return found[-1]


def as_owner(folder):
    """What commands begin with that run as who owns the folder, which is made; they end with this
    program. PostgreSQL refuses root: then it is nobody. All above the folder can be entered by others."""
    command = ["setpriv", "--pdeathsig", "INT"]
    folder.mkdir(parents=True, exist_ok=True)
    if os.geteuid() == 0:
        nobody = pwd.getpwnam("nobody")
        os.chown(folder, nobody.pw_uid, nobody.pw_gid)
        command += [f"--reuid={nobody.pw_uid}", f"--regid={nobody.pw_gid}", "--clear-groups"]
    return command


def ask(url, query):
    """Rows of words."""
    command = ["psql", "-XAt", "-F", "\t", url, "-c", query]
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
    return [line.split("\t") for line in done.stdout.splitlines()]


class Postgres:
    """In a folder, see as_owner."""

    def __init__(self, folder, port):
        self.folder, self.port = pathlib.Path(folder), port
        self.url = self.url_by(f"127.0.0.1:{port}")
        self._as = as_owner(self.folder)
        data = self.folder / "data"
        options = ["-k", "-A", "trust", "-U", USER, "-E", "UTF8", "--no-locale", "-D", data]
        self._run(program("initdb"), *options)
        options = f"-p {port} -h 127.0.0.1 -k {self.folder} -c max_connections=100"
        self.process = subprocess.Popen(
            [*self._as, program("postgres"), "-D", data, *options.split()],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            cwd="/",
        )

    def _run(self, *command):
        done = subprocess.run(
            [*self._as, *map(str, command)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            cwd="/",
        )
        if done.returncode != 0:
            raise RuntimeError(f"{command[0]}: {done.stderr}")

    @staticmethod
    def url_by(address):
        """Of the database, for who reaches it at host:port."""
        return f"postgresql://{USER}@{address}/missions"

    def make_database(self):
        """Whether it has been made: false as long as the server does not answer."""
        command = ["createdb", "-h", "127.0.0.1", "-p", str(self.port), "-U", USER, "missions"]
        return subprocess.run(command, stderr=subprocess.DEVNULL).returncode == 0

    def ask(self, query):
        return ask(self.url, query)

    def pids(self):
        return [self.process.pid]

    def stop(self):
        self.process.terminate()
        try:
            self.process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
