# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""The database in its production form, in a folder: etcd, PostgreSQL twice by Patroni, and HAProxy that
leads to the primary, with the shipped configurations. It has the face of postgres.Postgres."""

import json
import os
import pathlib
import signal
import subprocess
import time
import urllib.request

import fault_proxy
import postgres
import running

PASSWORD = "secret"
MACHINES = 2
CONFIGURATIONS = running.ROOT / "deploy/cluster"


class Machine:
    """One of the database: Patroni, which starts and minds PostgreSQL. start: runs a command as who
    PostgreSQL is. It reaches etcd by a link of its own, and its standby reaches it by another."""

    def __init__(self, name, folder, etcd, start):
        self.name, self.port, self.rest_port = name, running.free_port(), running.free_port()
        self._data, self._start, self._process = folder / name, start, None
        rest, database = f"127.0.0.1:{self.rest_port}", f"127.0.0.1:{self.port}"
        self.links = {"etcd": fault_proxy.Proxy(etcd), "standby": fault_proxy.Proxy(database)}
        self._environment = dict(
            os.environ,
            PATRONI_NAME=name,
            PATRONI_ETCD3_HOSTS=self.links["etcd"].target,
            PATRONI_ETCD3_USE_PROXIES="true",  # and not what etcd says where it is
            PATRONI_RESTAPI_LISTEN=rest,
            PATRONI_RESTAPI_CONNECT_ADDRESS=rest,
            PATRONI_POSTGRESQL_LISTEN=database,
            PATRONI_POSTGRESQL_CONNECT_ADDRESS=self.links["standby"].target,
            PATRONI_POSTGRESQL_DATA_DIR=str(self._data),
            PATRONI_SUPERUSER_USERNAME=postgres.USER,
            PATRONI_SUPERUSER_PASSWORD=PASSWORD,
            PATRONI_REPLICATION_USERNAME="replicator",
            PATRONI_REPLICATION_PASSWORD=PASSWORD,
            HOME=str(folder),
        )
        self._environment.pop("PYTHONPATH", None)

    def start(self):
        command = ["/usr/bin/patroni", CONFIGURATIONS / "patroni.yml"]
        self._process = self._start(command, self._environment, f"{self.name}.log")
        self.pid = self._process.pid

    def is_primary(self):
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{self.rest_port}/primary", timeout=2):
                return True
        except OSError:
            return False

    def kill(self):
        """As a machine that loses its power."""
        postmaster = int((self._data / "postmaster.pid").read_text().split()[0])
        for pid in (self._process.pid, postmaster):
            os.kill(pid, signal.SIGKILL)
        self._process.wait()

    def stop(self):
        self._process.send_signal(signal.SIGTERM)
        try:
            self._process.wait(timeout=30)
        except subprocess.TimeoutExpired:
            self.kill()
        for link in self.links.values():
            link.stop()


class Patroni:
    name = "the primary"

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self._owner = postgres.as_owner(self.folder)
        self._etcd_port, peer_port = running.free_port(), running.free_port()
        peer = f"http://127.0.0.1:{peer_port}"
        client = f"http://127.0.0.1:{self._etcd_port}"
        options = ["--name", "e", "--data-dir", self.folder / "etcd"]
        options += ["--listen-client-urls", client, "--advertise-client-urls", client]
        options += ["--listen-peer-urls", peer, "--initial-advertise-peer-urls", peer]
        options += ["--initial-cluster", f"e={peer}"]
        self._etcd = self._start(["/usr/bin/etcd", *options], os.environ, "etcd.log")
        etcd = f"127.0.0.1:{self._etcd_port}"
        names = [f"db{i + 1}" for i in range(MACHINES)]
        self._machines = [Machine(name, self.folder, etcd, self._start) for name in names]
        for machine in self._machines:
            machine.start()
        self.port = running.free_port()
        self.url = self.url_by(f"127.0.0.1:{self.port}")
        self._front = self._start_front()
        running.await_that(self._has_standby, "a primary with a synchronous standby", 120)

    @staticmethod
    def url_by(address):
        return f"postgresql://{postgres.USER}:{PASSWORD}@{address}/missions"

    def _start(self, command, environment, log):
        with open(self.folder / log, "ab") as sink:
            return subprocess.Popen(
                [*self._owner, *map(str, command)],
                env=environment,
                stdout=sink,
                stderr=sink,
                cwd=self.folder,
            )

    def _start_front(self):
        environment = dict(os.environ, PLUMESCOUT_DATABASE_BIND=f"127.0.0.1:{self.port}")
        for number, machine in enumerate(self._machines, 1):
            environment[f"PLUMESCOUT_DB_{number}"] = f"127.0.0.1:{machine.port}"
            environment[f"PLUMESCOUT_DB_{number}_REST"] = str(machine.rest_port)
        environment["PLUMESCOUT_DB_3"] = "127.0.0.1:1"  # nobody
        program = os.environ.get("PLUMESCOUT_HAPROXY") or "/usr/sbin/haproxy"
        command = [program, "-db", "-f", CONFIGURATIONS / "database.cfg"]
        return self._start(command, environment, "haproxy.log")

    def _has_standby(self):
        """Which Patroni would promote."""
        for machine in self._machines:
            try:
                url = f"http://127.0.0.1:{machine.rest_port}/cluster"
                with urllib.request.urlopen(url, timeout=2) as answer:
                    members = json.load(answer)["members"]
            except (OSError, ValueError):
                continue
            if any(m["role"] == "sync_standby" and m["state"] == "running" for m in members):
                return True
        return False

    def make_database(self):
        command = ["psql", "-X", self.url.replace("/missions", "/postgres"), "-c"]
        return subprocess.run([*command, "CREATE DATABASE missions"]).returncode == 0

    def ask(self, query):
        return postgres.ask(self.url, query)

    def primary(self, chance, while_down):
        """A fault: the primary's machine is gone, and comes back once another has its place."""
        del chance
        primary = self._await_primary()
        began = time.monotonic()
        primary.kill()
        self._await_another(primary, "is gone", began)
        while_down()
        print(f"all robots go on {time.monotonic() - began:.1f} s after it was gone", flush=True)
        primary.start()

    def split(self, chance, while_down):
        """A fault: the primary's machine hears nothing any more from etcd, its standby, or both, while
        servers reach it, until they go on."""
        primary = self._await_primary()
        cut = chance.choice((("etcd",), ("standby",), ("etcd", "standby")))
        began = time.monotonic()
        for name in cut:
            primary.links[name].set_state("half_open")
        if "etcd" in cut:
            self._await_another(primary, f"is cut from {' and '.join(cut)}", began)
        while_down()
        passed_s = time.monotonic() - began
        print(f"all robots go on {passed_s:.1f} s after the cut from {' and '.join(cut)}", flush=True)
        for name in cut:
            primary.links[name].set_state("up")

    def _await_primary(self):
        running.await_that(self._has_standby, "there is a standby again", 180)
        return next(machine for machine in self._machines if machine.is_primary())

    def _await_another(self, primary, what, began):
        others = [machine for machine in self._machines if machine is not primary]
        running.await_that(lambda: any(m.is_primary() for m in others), "another is primary", 120)
        passed_s = time.monotonic() - began
        print(f"{primary.name} {what}; another is primary after {passed_s:.1f} s", flush=True)

    def pids(self):
        return [process.pid for process in (self._front, self._etcd)] + [
            machine.pid for machine in self._machines
        ]

    def stop(self):
        for machine in self._machines:
            machine.stop()
        for process in (self._front, self._etcd):
            process.kill()
            process.wait()
