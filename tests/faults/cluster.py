# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A cluster on this machine under faults: PostgreSQL, three servers, the shipped router, and eight
robots in four missions. scripts/cluster builds and runs it.

  --seconds S        how long robots work
  --kill-every S     so often a server is killed (kill -9), and started again at once
  --pause-every S    so often a server is stopped (SIGSTOP) for longer than its lease, then goes on
  --roll-every S     so often a server is drained, and started again

At the end each mission is exported, and a server of its own takes it in, replays it and compares its
digest; what robots were answered has to stand in the journal, once. Exit code 1 if it does not.
"""

import argparse
import collections
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

import answers
import bed
import plumescout
import postgres
import robots
import running

ROBOTS, MISSIONS, NODES = 8, 4, 3
EACH = ROBOTS // MISSIONS
LEASE_S = 1.0
SHOW_S = 5.0
OWNERS = (
    "SELECT encode(m.key, 'escape'), coalesce(n.name, '-'), p.epoch, p.head "
    "FROM plumescout_mission m JOIN plumescout_progress p ON p.mission = m.id "
    "LEFT JOIN plumescout_node n ON n.id = p.owner AND n.expires > clock_timestamp() ORDER BY 1"
)


class Router:
    """HAProxy with the shipped configuration."""

    def __init__(self, nodes):
        self.target = f"127.0.0.1:{running.free_port()}"
        environment = dict(os.environ, PLUMESCOUT_ROUTER_BIND=self.target)
        for number, node in enumerate(nodes, 1):
            environment[f"PLUMESCOUT_NODE_{number}"] = node.server.target
            environment[f"PLUMESCOUT_NODE_{number}_HTTP"] = str(node.http_port)
        program = os.environ.get("PLUMESCOUT_HAPROXY") or "/usr/sbin/haproxy"
        self._process = subprocess.Popen(
            [program, "-db", "-f", running.ROOT / "deploy/cluster/haproxy.cfg"],
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def answers(self):
        try:
            with plumescout.Client(self.target, timeout_s=0.5) as client:
                client.list_missions()
            return True
        except plumescout.PlumeScoutError:
            return False

    def stop(self):
        self._process.kill()
        self._process.wait()


class Node:
    def __init__(self, name, folder, store):
        self.name, self.http_port = name, running.free_port()
        (folder / name).mkdir()
        self.server = bed.Server(
            folder / name,
            f"observe.http_listen=127.0.0.1:{self.http_port}",
            f"store.node={name}",
            f"store.lease_s={LEASE_S}",
            store=store,
        ).start()

    def kill(self, _):
        self.server.kill()
        self.server.start()

    def pause(self, seconds):
        os.kill(self.server.process.pid, signal.SIGSTOP)
        time.sleep(seconds)
        os.kill(self.server.process.pid, signal.SIGCONT)

    def roll(self, _):
        self.server.stop()
        self.server.start()


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


class Cluster:
    """Everything, begun; `stop` ends it. say: hears a line now and then."""

    def __init__(self, folder, say=print):
        self.say, self.faults, self.waits_s = say, 0, []
        self._folder = pathlib.Path(folder)
        self._folder.chmod(0o755)  # PostgreSQL is another user
        self._database = postgres.Postgres(self._folder / "postgres", running.free_port())
        running.await_that(self._database.make_database, "PostgreSQL answers")
        self.nodes = [Node(f"n{i + 1}", self._folder, self._database.url) for i in range(NODES)]
        self.router = Router(self.nodes)
        running.await_that(self.router.answers, "the router leads to a node")
        self.told = answers.Answers()
        self.missions = [f"mission-{i + 1}" for i in range(MISSIONS)]
        for mission in self.missions:
            with robots.Stubs(self.router.target, robots.Route(mission)) as stubs:
                robots.create_mission(stubs, mission, self.told, options=robots.cheap_options())
        self.team = [
            robots.Robot(self.router.target, mission, index, self.told, period_s=0.06)
            for mission in self.missions
            for index in range(EACH)
        ]
        for robot in self.team:
            robot.start()
        running.await_that(lambda: all(r.durable > 0 for r in self.team), "all robots are served")
        self._waits = Waits(self.team)

    def await_progress(self):
        before = [robot.durable for robot in self.team]
        running.await_that(
            lambda: all(robot.durable > was for robot, was in zip(self.team, before)),
            "all robots go on",
        )

    def fault(self, kind, node, chance):
        """kill, pause or roll. Returns once all robots have gone on."""
        self._waits.reset()
        began = time.monotonic()
        getattr(node, kind)(chance.uniform(1.5, 3.0) * LEASE_S)
        self.await_progress()
        # Robots that did not notice are not part of it.
        hit = [wait for wait in self._waits.worst() if wait > LEASE_S / 2]
        self.waits_s += hit
        self.faults += 1
        self.say(
            f"{kind} {node.name}: all robots go on after {time.monotonic() - began:.1f} s, "
            f"{len(hit)} waited, {max(hit, default=0):.2f} s at most"
        )

    def show(self):
        for key, node, epoch, head in self._database.ask(OWNERS):
            mission = key.rsplit("/", 1)[-1]
            ones = [r for r in self.team if f"missions/{mission}/" in r.resource]
            self.say(
                f"  {mission:12} {node:4} epoch {epoch:>3}  {head:>6} events  "
                f"{sum(r.durable for r in ones):>6} observations  "
                f"{sum(r.plans for r in ones):>4} plans"
            )

    def stop_robots(self):
        self._waits.stop()
        for robot in self.team:
            robot.stop()

    def breaches(self):
        """[sentence ...] of promises that were not kept. After stop_robots."""
        own = self._folder / "own"
        own.mkdir()
        server = bed.Server(own).start()
        try:
            for mission in self.missions:
                file = own / f"{mission}.journal"
                with plumescout.Client(self.router.target, timeout_s=60) as client:
                    self._persist(lambda: client.export_mission(mission, file))
                with plumescout.Client(server.target, timeout_s=60) as client:
                    client.import_mission(file)
        finally:
            server.stop()
        found = answers.breaches(answers.read(server.data), self.told, robots.names(EACH))
        return found + [breach for robot in self.team for breach in robot.breaches]

    @staticmethod
    def _persist(call):
        deadline = time.monotonic() + bed.PATIENCE_S
        while True:
            try:
                return call()
            except plumescout.PlumeScoutError:
                if time.monotonic() > deadline:
                    raise
            time.sleep(0.2)

    def stop(self):
        self.router.stop()
        for node in self.nodes:
            node.server.kill()
        self._database.stop()

    def summary(self, breaches):
        waits = sorted(self.waits_s) or [0.0]
        verdict = f"{len(breaches)} BREACHES" if breaches else "0 lost, 0 doubled, 0 forks"
        return (
            f"{self.faults} faults; {sum(r.durable for r in self.team)} observations were "
            f"acknowledged, {self.told.count('plan')} plans answered, "
            f"{sum(r.route.redirects for r in self.team)} redirects; robots that a fault hit waited "
            f"{waits[len(waits) // 2]:.2f} s (p50), {waits[-1]:.2f} s (max): {verdict}"
        )


def due(kinds, begin, done):
    """The kind whose next time has come, or None. kinds: {kind: period, s}."""
    for kind, period_s in kinds.items():
        if time.monotonic() - begin > (done[kind] + 1) * period_s:
            done[kind] += 1
            return kind
    return None


def main():
    parser = argparse.ArgumentParser(
        prog="scripts/cluster",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--seconds", type=float, default=60)
    for kind in ("kill", "pause", "roll"):
        parser.add_argument(f"--{kind}-every", type=float)
    parser.add_argument("--seed", type=int, default=int(time.time()) % 1_000_000)
    arguments = parser.parse_args()
    chance = random.Random(arguments.seed)
    periods = {kind: getattr(arguments, f"{kind}_every") for kind in ("kill", "pause", "roll")}
    kinds = {kind: period_s for kind, period_s in periods.items() if period_s}
    folder = tempfile.mkdtemp(prefix="plumescout-cluster-")
    print(f"--seed {arguments.seed}, in {folder}", flush=True)
    cluster = Cluster(folder, say=lambda line: print(line, flush=True))
    try:
        begin, shown, done = time.monotonic(), 0.0, collections.Counter()
        while time.monotonic() - begin < arguments.seconds:
            if kind := due(kinds, begin, done):
                cluster.fault(kind, chance.choice(cluster.nodes), chance)
            if time.monotonic() - shown > SHOW_S:
                cluster.show()
                shown = time.monotonic()
            time.sleep(0.1)
        cluster.stop_robots()
        breaches = cluster.breaches()
        print(cluster.summary(breaches), *breaches, sep="\n  ")
    finally:
        cluster.stop()
    shutil.rmtree(folder, ignore_errors=True)
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main())
