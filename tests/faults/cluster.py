# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A cluster on this machine under faults: PostgreSQL, three servers, the shipped router, and eight
robots in four missions. scripts/cluster builds and runs it.

  --seconds S        how long robots work
  --kill-every S     so often a server is killed (kill -9), and started again at once
  --pause-every S    so often a server is stopped (SIGSTOP) for longer than its lease, then goes on
  --cut-every S      so often a server's link to the database, and no other, is cut or goes silent for
                     longer than its lease
  --unroute-every S  so often the routers lead to a server no more, which lives and has its lease, until
                     all robots go on
  --roll-every S     so often a server is drained, and started again; each in its turn
  --database patroni the database with a standby, as production has it; needs Debian's patroni and
                     etcd-server, which scripts/cluster then installs
  --kill-primary-every S
                     so often its primary is killed, with its Patroni, until another has its place
  --split-primary-every S
                     so often its primary hears nothing from etcd, its standby, or both, while servers
                     reach it
  --proxies N        routers, 1 or 2: the second has the nodes in another order, and half of the robots
  --nodes N          servers, 1 to 3; if there are faults, n2's clock is an hour
                     ahead
  --router-share S   of a core, that a router gets at most; needs root
  --robots N --missions M --pause S --plan-pause S
                     how many, and how long each waits between what it sends and before it plans

At the end each mission is exported, and a server of its own takes it in, replays it and compares its
digest; what robots were answered has to stand in the journal, once. Exit code 1 if it does not.
"""

import argparse
import collections
import dataclasses
import pathlib
import random
import shutil
import sys
import tempfile
import time

import answers
import bed
import patroni
import plumescout
import postgres
import robots
import running
from cluster_parts import LEASE_S, OWNERS, Node, Router, Waits, cpu_s, percentile

KINDS = ("kill", "pause", "cut", "roll", "unroute")
DATABASE_KINDS = {"primary": "kill_primary_every", "split": "split_primary_every"}
CLOCKS = {"n1": 0, "n2": 3600, "n3": 0}  # how far each server's wall clock is off, in seconds
SHOW_S = 5.0


@dataclasses.dataclass
class Shape:
    nodes: int = 3
    proxies: int = 1
    robots: int = 8
    missions: int = 4
    pause_s: float = 0.06
    plan_pause_s: float = 0.2
    cuttable: bool = True  # links to the database; costs CPU
    clocks_apart: bool = True  # costs CPU, too
    database: str = "single"  # or "patroni"
    router_share: float = 0.0  # of a core, that each router gets; 0: all it wants


class Cluster:
    """Everything, begun; `stop` ends it. say: hears a line now and then. owner_faults: those that hit
    who had missions, all of which are under load."""

    def __init__(self, folder, shape=Shape(), say=print):
        self.say, self.faults, self.owner_faults, self.waits_s = say, 0, 0, []
        self._shape = shape
        self._folder = pathlib.Path(folder)
        self._folder.chmod(0o755)  # PostgreSQL is another user
        where = self._folder / "postgres"
        if shape.database == "patroni":
            self.database = patroni.Patroni(where)
        else:
            self.database = postgres.Postgres(where, running.free_port())
        running.await_that(self.database.make_database, "PostgreSQL answers")
        address = f"127.0.0.1:{self.database.port}"
        names = [f"n{i + 1}" for i in range(shape.nodes)]
        clocks_s = [CLOCKS[name] if shape.clocks_apart else 0 for name in names]
        self.nodes = [
            Node(name, self._folder, self.database.url_by, address, shape.cuttable, clock_s)
            for name, clock_s in zip(names, clocks_s)
        ]
        self.routers = [Router(self.nodes, self._folder, o) for o in (1, -1)[: shape.proxies]]
        for router in self.routers:
            running.await_that(router.answers, "the router leads to a node")
            if shape.router_share:
                router.hold_to(shape.router_share)
        for node in self.nodes:
            node.routers = self.routers
        self.told = answers.Answers()
        self.missions = [f"mission-{i + 1}" for i in range(shape.missions)]
        self._each = shape.robots // shape.missions
        self.team = [robot for mission in self.missions for robot in self._crew(mission)]
        for robot in self.team:
            robot.start()
        running.await_that(lambda: all(r.durable > 0 for r in self.team), "all robots are served")
        self._waits = Waits(self.team)
        self._cpu_s, self._durable = self._cpu(), self._acknowledged()
        self._began = time.monotonic()

    def _crew(self, mission):
        """Its robots, each at another router than the one before."""
        with robots.Stubs(self.routers[0].target, robots.Route(mission)) as stubs:
            robots.create_mission(stubs, mission, self.told, options=robots.cheap_options())
        pace = {"period_s": self._shape.pause_s, "plan_period_s": self._shape.plan_pause_s}
        for index in range(self._each):
            router = self.routers[index % len(self.routers)]
            yield robots.Robot(router.target, mission, index, self.told, **pace)

    def _acknowledged(self):
        return sum(robot.durable for robot in self.team)

    def _cpu(self):
        return {
            "servers": sum(cpu_s(node.server.process.pid) for node in self.nodes),
            "HAProxy": sum(cpu_s(router.process.pid) for router in self.routers),
            "PostgreSQL": sum(map(cpu_s, self.database.pids())),
        }

    def cost(self):
        """In words: CPU for each observation that was acknowledged since the robots began."""
        events, spent_s = self._acknowledged() - self._durable, time.monotonic() - self._began
        cpu_s = {part: spent - self._cpu_s[part] for part, spent in self._cpu().items()}
        parts = [f"{part} {1e6 * spent / events:.0f}" for part, spent in cpu_s.items()]
        return (
            f"microseconds of CPU an observation, of {events}, {events / spent_s:.0f} a second: "
            f"{', '.join(parts)}; HAProxy took {cpu_s['HAProxy'] / spent_s:.3f} cores"
        )

    def await_owner(self, mission):
        """The node that has it, as robots go on, and who had which mission then."""

        def find():
            rows = self.database.ask(OWNERS)
            names = [name for key, name, *_ in rows if key.rsplit("/", 1)[-1] == mission]
            return next(((node, rows) for node in self.nodes if node.name in names), None)

        return running.await_that(find, f"somebody has {mission}")

    def await_progress(self):
        before = [robot.durable for robot in self.team]
        running.await_that(
            lambda: all(robot.durable > was for robot, was in zip(self.team, before)),
            "all robots go on",
        )

    def fault(self, kind, node, chance, rows=None):
        """One of KINDS, or of DATABASE_KINDS. Returns once all robots have gone on. rows: who
        has which mission, if that is known."""
        owners = [name for _, name, *_ in rows or self.database.ask(OWNERS)]
        owned = owners if node is self.database else [n for n in owners if n == node.name]
        self.owner_faults += bool(owned)
        self._waits.reset()
        began = time.monotonic()
        getattr(node, kind)(chance, self.await_progress)
        self.await_progress()
        # Robots that did not notice are not part of it.
        hit = [wait for wait in self._waits.worst() if wait > LEASE_S / 2]
        self.waits_s += hit
        self.faults += 1
        self.say(
            f"{kind} {node.name} ({len(owned)} missions): all robots go on after "
            f"{time.monotonic() - began:.1f} s, "
            f"{len(hit)} waited, {max(hit, default=0):.2f} s at most"
        )

    def show(self):
        for key, node, epoch, head in self.database.ask(OWNERS):
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
        server = bed.Server(own, "limits.memory_budget_bytes=17179869184").start()
        try:
            for mission in self.missions:
                file = own / f"{mission}.journal"
                with plumescout.Client(self.routers[0].target, timeout_s=60) as client:
                    self._persist(lambda: client.export_mission(mission, file))
                with plumescout.Client(server.target, timeout_s=60) as client:
                    client.import_mission(file)
        finally:
            server.stop()
        found = answers.breaches(answers.read(server.data), self.told, robots.names(self._each))
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
        for router in self.routers:
            router.stop()
        for node in self.nodes:
            node.stop()
        self.database.stop()

    def summary(self, breaches):
        waits = sorted(self.waits_s) or [0.0]
        verdict = f"{len(breaches)} BREACHES" if breaches else "0 lost, 0 doubled, 0 forks"
        plans_s = [wait for robot in self.team for wait in robot.plan_waits_s]
        slowest_s, told = max(robot.slowest_plan for robot in self.team)
        answers = [f"{count} × {name}" for name, count in collections.Counter(told).items()]
        failures = sum((robot.route.failures for robot in self.team), collections.Counter())
        return (
            f"{self.faults} faults, {self.owner_faults} of them to who had missions; {sum(r.durable for r in self.team)} observations were "
            f"acknowledged, {self.told.count('plan')} plans answered, "
            f"{sum(r.route.redirects for r in self.team)} redirects; robots that a fault hit waited "
            f"{waits[len(waits) // 2]:.2f} s (p50), {waits[-1]:.2f} s (max); plans were waited for "
            f"{percentile(plans_s, 0.5):.3f} s (p50), {percentile(plans_s, 0.99):.3f} s (p99), "
            f"{slowest_s:.3f} s (max, told before: {', '.join(answers) or 'nothing'}); calls "
            f"that ended otherwise: {dict(failures)}: {verdict}"
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
    for kind in KINDS:
        parser.add_argument(f"--{kind}-every", type=float)
    for name, standard in (("nodes", 3), ("proxies", 1), ("robots", 8), ("missions", 4)):
        parser.add_argument(f"--{name}", type=int, default=standard)
    parser.add_argument("--database", choices=("single", "patroni"), default="single")
    parser.add_argument("--kill-primary-every", type=float)
    parser.add_argument("--split-primary-every", type=float)
    parser.add_argument("--router-share", type=float, default=0.0)
    parser.add_argument("--pause", type=float, default=0.06)
    parser.add_argument("--plan-pause", type=float, default=0.2)
    parser.add_argument("--seed", type=int, default=int(time.time()) % 1_000_000)
    arguments = parser.parse_args()
    chance = random.Random(arguments.seed)
    periods = {kind: getattr(arguments, f"{kind}_every") for kind in KINDS}
    periods |= {kind: getattr(arguments, option) for kind, option in DATABASE_KINDS.items()}
    kinds = {kind: period_s for kind, period_s in periods.items() if period_s}
    if DATABASE_KINDS.keys() & kinds.keys() and arguments.database != "patroni":
        parser.error("there is no primary with a standby but with --database patroni")
    shape = Shape(
        *(getattr(arguments, name) for name in ("nodes", "proxies", "robots", "missions", "pause")),
        plan_pause_s=arguments.plan_pause,
        cuttable="cut" in kinds,
        clocks_apart=bool(kinds),
        database=arguments.database,
        router_share=arguments.router_share,
    )
    folder = tempfile.mkdtemp(prefix="plumescout-cluster-")
    print(f"--seed {arguments.seed}, in {folder}", flush=True)
    cluster = Cluster(folder, shape, say=lambda line: print(line, flush=True))
    try:
        begin, shown, done = time.monotonic(), 0.0, collections.Counter()
        while time.monotonic() - begin < arguments.seconds:
            if kind := due(kinds, begin, done):
                turn = cluster.nodes[done[kind] % shape.nodes]
                others = cluster.database if kind in DATABASE_KINDS else chance.choice(cluster.nodes)
                cluster.fault(kind, turn if kind == "roll" else others, chance)
            if time.monotonic() - shown > SHOW_S:
                cluster.show()
                shown = time.monotonic()
            time.sleep(0.1)
        if not kinds:  # who was started again has none of what it spent before
            print(cluster.cost())
        cluster.stop_robots()
        breaches = cluster.breaches()
        print(cluster.summary(breaches), *breaches, sep="\n  ")
    finally:
        cluster.stop()
    shutil.rmtree(folder, ignore_errors=True)
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main())
