# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What a cluster on this machine is made of: routers, nodes whose links to the database can be cut,
and who watches what robots wait for."""

import collections
import os
import pathlib
import signal
import socket
import subprocess
import threading
import time

import bed
import fault_proxy
import plumescout
import running

LEASE_S = 1.0
NAMES = ("n1", "n2", "n3")  # in the shipped configuration
CONFIGURATION = running.ROOT / "deploy/cluster/haproxy.cfg"
# Of each mission its key, its node or -, its epoch and how many events it has.
OWNERS = (
    "SELECT encode(m.key, 'escape'), coalesce(n.name, '-'), p.epoch, p.head "
    "FROM plumescout_mission m JOIN plumescout_progress p ON p.mission = m.id "
    "LEFT JOIN plumescout_node n ON n.id = p.owner AND n.expires > clock_timestamp() ORDER BY 1"
)


class Router:
    """HAProxy with the shipped configuration. order: of the nodes in its list, which the hash goes by:
    routers with different lists take missions to different nodes. certificates: a folder with those
    of the cluster's authority and of the router; without, it speaks plaintext to the nodes."""

    def __init__(self, nodes, folder, order=1, certificates=None):
        self.target = f"127.0.0.1:{running.free_port()}"
        environment = dict(os.environ, PLUMESCOUT_ROUTER_BIND=self.target)
        if certificates:
            environment["PLUMESCOUT_ROUTER_CERTIFICATE"] = str(certificates / "router.crt")
            environment["PLUMESCOUT_ROUTER_NODE_CA"] = str(certificates / "ca.crt")
        else:
            environment["PLUMESCOUT_ROUTER_PLAINTEXT"] = "1"
        for number, node in enumerate(nodes, 1):
            environment[f"PLUMESCOUT_NODE_{number}"] = node.server.target
            environment[f"PLUMESCOUT_NODE_{number}_HTTP"] = str(node.http_port)
        lines = CONFIGURATION.read_text().splitlines()
        listed = [line for line in lines if line.split()[:1] == ["server"]]
        names = {node.name for node in nodes}
        kept = [line for line in listed if line.split()[1] in names][::order]
        rest = [line for line in lines if line not in listed]
        rest = [line for line in rest if not self._uses_another(line, names)]
        self._group = None
        self._admin = f"{folder}/haproxy{order}.sock"
        rest.insert(rest.index("global") + 1, f"    stats socket {self._admin} level admin")
        own = pathlib.Path(folder) / f"haproxy{order}.cfg"
        own.write_text("\n".join([*rest, *kept, ""]))
        program = os.environ.get("PLUMESCOUT_HAPROXY") or "/usr/sbin/haproxy"
        self.process = subprocess.Popen(
            [program, "-db", "-f", own],
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    @staticmethod
    def _uses_another(line, names):
        used = [name for name in NAMES if f"use-server {name} " in line or f"nodes/{name})" in line]
        return bool(set(used) - names)

    def hold_to(self, share):
        """It gets no more than this share of one core from now on. Needs root."""
        root = pathlib.Path("/sys/fs/cgroup")
        is_second = (root / "cgroup.controllers").exists()
        group = root / ("" if is_second else "cpu") / f"plumescout-{self.process.pid}"
        group.mkdir()
        quota_us, period_us = 1000, round(1000 / share)
        if is_second:
            (group / "cpu.max").write_text(f"{quota_us} {period_us}")
        else:
            (group / "cpu.cfs_period_us").write_text(str(period_us))
            (group / "cpu.cfs_quota_us").write_text(str(quota_us))
        (group / "cgroup.procs").write_text(str(self.process.pid))
        self._group = group

    def lead(self, node, leads):
        """Whether it leads to the node of this name, from now on; it does not lose it by that."""
        command = f"{'enable' if leads else 'disable'} server nodes/{node}\n"
        with socket.socket(socket.AF_UNIX) as admin:
            admin.connect(self._admin)
            admin.sendall(command.encode())
            said = admin.recv(4096).strip()
        if said:
            raise RuntimeError(f"{command.strip()}: {said.decode()}")

    def answers(self):
        try:
            with plumescout.Client(self.target, timeout_s=0.5) as client:
                client.list_missions()
            return True
        except plumescout.PlumeScoutError:
            return False

    def stop(self):
        self.process.kill()
        self.process.wait()
        if self._group:
            self._group.rmdir()


def by_clock(offset_s):
    """The environment of a program whose wall clock is off by so much; its steady clock goes on."""
    if offset_s == 0:
        return {}
    libraries = sorted(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"))
    if not libraries:
        raise RuntimeError("no libfaketime: scripts/setup --cluster")
    return {
        "LD_PRELOAD": str(libraries[0]),
        "FAKETIME": f"{offset_s:+}s",
        "FAKETIME_DONT_FAKE_MONOTONIC": "1",
    }


class Node:
    """A server, which reaches the database through a proxy of its own if its link is to be cut."""

    def __init__(
        self, name, folder, store_of, database, cuttable, clock_s=0, lease_s=LEASE_S
    ):
        self.name, self.http_port, self.routers = name, running.free_port(), []
        self._link = fault_proxy.Proxy(database) if cuttable else None
        (folder / name).mkdir()
        self.server = bed.Server(
            folder / name,
            f"observe.http_listen=127.0.0.1:{self.http_port}",
            f"store.node={name}",
            f"store.lease_s={lease_s}",
            "limits.max_missions=256",
            "limits.memory_budget_bytes=17179869184",
            environment=by_clock(clock_s),
            store=store_of(self._link.target if cuttable else database),
        ).start()

    # Faults. while_down: called while the node is out, for as long as others take to go on.

    def kill(self, chance, while_down):
        del chance, while_down
        self.server.kill()
        self.server.start()

    def pause(self, chance, while_down):
        os.kill(self.server.process.pid, signal.SIGSTOP)
        time.sleep(chance.uniform(1.5, 3.0) * LEASE_S)
        os.kill(self.server.process.pid, signal.SIGCONT)

    def cut(self, chance, while_down):
        """From the database alone: robots and routers reach it all the time."""
        self._link.set_state(chance.choice(("cut", "half_open")))
        time.sleep(chance.uniform(1.5, 3.0) * LEASE_S)
        while_down()
        self._link.set_state("up")

    def unroute(self, chance, while_down):
        """No router leads to it: it lives, and has its lease."""
        del chance
        for router in self.routers:
            router.lead(self.name, False)
        while_down()
        for router in self.routers:
            router.lead(self.name, True)

    def roll(self, chance, while_down):
        del chance, while_down
        self.server.stop()
        self.server.start()

    def stop(self):
        self.server.kill()
        if self._link is not None:
            self._link.stop()


class Waits:
    """How long each robot was not told that anything is durable, at worst, since it was asked."""

    def __init__(self, team):
        self._team = team
        self._worst = collections.defaultdict(float)
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._watch)
        self._thread.start()

    def reset(self):
        self._worst = collections.defaultdict(float)

    def worst(self):
        return list(self._worst.values())

    def _watch(self):
        while not self._stop.wait(0.02):
            now, worst = time.monotonic(), self._worst
            for robot in self._team:
                worst[id(robot)] = max(worst[id(robot)], now - robot.last_acknowledged_s)

    def stop(self):
        self._stop.set()
        self._thread.join()


def cpu_s(pid):
    """Of a process and all that it has or had below it."""
    try:
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
        below = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    except OSError:
        return 0.0  # gone meanwhile
    own = sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")
    return own + sum(cpu_s(child) for child in below)


def percentile(values, share):
    ordered = sorted(values) or [0.0]
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]
