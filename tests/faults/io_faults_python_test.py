# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A fault at every step of input and output: the N-th write, sync, truncation, rename or unlink
fails, once or for ever, or the process ends there, with half of a write done or none of it.

Then the server is started again without faults, and has to keep what it answered before. So it goes
with faults while it recovers what a kill left.
"""

import collections
import dataclasses
import signal
import struct
import unittest

import grpc

import answers
import bed
import robots
import session

MODES = ("eio_once", "eio_forever", "enospc_once", "enospc_forever", "half_exit", "exit")
POINTS = {"ci": 160, "long": None}  # None: all there are
RECOVERY_POINTS = {"ci": 48, "long": None}
RETURN_S = 5.0
RECOVERY_S = 1.0  # of a mission: with faults, longer is not waited
WAIT = "limits.max_wait_s=0.5"  # calls do not wait longer for the disk
# What a call may end with when the disk is to blame: typed, or no server.
STORE_REASONS = {"STORE_UNAVAILABLE", "STORE_DAMAGED", "FENCED", "RECOVERING"}


@dataclasses.dataclass
class Point:
    """One run: where the fault is, and what came of it."""

    mode: str
    at: int
    fired: int = 0
    started: bool = True
    failures: list = dataclasses.field(default_factory=list)
    complaints: list = dataclasses.field(default_factory=list)


def shim(folder, mode="", at=0):
    return {
        "LD_PRELOAD": str(bed.SHIM),
        "FAULT_FOLDER": str(folder / "data"),
        "FAULT_COUNTER": str(folder / "counter"),
        "FAULT_MODE": mode,
        "FAULT_AT": str(at),
    }


def counter(folder):
    """Operations, and those that were made to fail."""
    path = folder / "counter"
    return struct.unpack("<QQ", path.read_bytes()) if path.exists() else (0, 0)


def spread(count, points):
    """Points evenly over 1 to count for every mode; all if points is None."""
    if points is None:
        return [(mode, at) for at in range(1, count + 1) for mode in MODES]
    each = points // len(MODES)
    chosen = []
    for phase, mode in enumerate(MODES):
        for i in range(each):
            share = (i + (phase + 0.5) / len(MODES)) / each
            chosen.append((mode, 1 + min(count - 1, int(share * count))))
    return chosen


class IoFaultsTest(unittest.TestCase):
    def setUp(self):
        self.folder = bed.folder_of(self)

    def test_a_fault_while_it_serves(self):
        count = self.operations_of_a_session()
        points = [Point(*p) for p in spread(count, bed.size(POINTS["ci"], POINTS["long"]))]
        bed.two_at_a_time(self.run_with_fault, points)
        self.tell("serving", count, points)

    def test_a_fault_while_it_recovers(self):
        left, told = self.what_a_kill_leaves()
        count = self.operations_of_a_recovery(left, told)
        places = spread(count, bed.size(RECOVERY_POINTS["ci"], RECOVERY_POINTS["long"]))
        points = [Point(*place) for place in places]
        bed.two_at_a_time(lambda point: self.recover_with_fault(point, left, told), points)
        self.tell("recovering", count, points)

    # With a fault, a server may fail to start; it says why, and does not crash.
    def start(self, server, point):
        try:
            server.start()
            return True
        except bed.DidNotStart as end:
            point.started = False
            if point.mode in ("half_exit", "exit"):
                self.complain_unless(end.code == bed.EXIT_BY_FAULT, point, end)
            else:
                self.complain_unless(end.says_why, point, end)
            return False

    def complain_unless(self, good, point, text):
        if not good:
            point.complaints.append(str(text)[-1500:])

    def operations_of_a_session(self):
        folder = bed.folder_of(self, self.folder)
        server = bed.Server(folder, WAIT, environment=shim(folder))
        server.start()
        run = session.Session(server.target, answers.Answers()).run()
        server.kill()
        self.assertEqual(run.failures, [])
        return counter(folder)[0]

    def run_with_fault(self, point):
        folder = bed.folder_of(self, self.folder)
        server = bed.Server(folder, WAIT, environment=shim(folder, point.mode, point.at))
        told = answers.Answers()
        try:
            if self.start(server, point):
                run = session.Session(server.target, told).run()
                point.failures = run.failures
                self.judge_life(server, point)
        finally:
            server.kill()
        point.fired = counter(folder)[1]
        self.judge_folder(server, point, told)

    def judge_life(self, server, point):
        """After the session the server lives, unless it was to end, and says what is wrong."""
        if point.mode in ("half_exit", "exit"):
            return
        self.complain_unless(server.alive(), point, f"ended: {server.log()}")
        for step, code, reason, message in point.failures:
            # A deletion whose own commit is the first to fail waits as long as its caller does.
            waited = step == "delete" and code == grpc.StatusCode.DEADLINE_EXCEEDED
            named = reason in STORE_REASONS or code == grpc.StatusCode.NOT_FOUND or waited
            self.complain_unless(named, point, f"{step}: {code.name} {reason} {message}")
        if point.mode.endswith("_once"):
            self.judge_return(server, point)

    def judge_return(self, server, point):
        """A disk that failed once is taken for well again before long."""
        with robots.Stubs(server.target) as stubs:
            try:
                robots.create_mission(stubs, "later", patience_s=RETURN_S)
            except grpc.RpcError as error:
                point.complaints.append(f"does not go on: {error.details()}")

    def judge_folder(self, server, point, told):
        """Without faults it opens, and everything that was answered is there."""
        server.environment = {}
        try:
            server.start()
        except bed.DidNotStart as end:
            point.complaints.append(f"does not open afterwards: {end}")
            return
        try:
            point.complaints += session.kept_promises(server.target, told)
        finally:
            code = server.stop()
        self.complain_unless(code == 0, point, f"exit code {code} when stopped")
        try:
            journals = answers.read(server.data)
            point.complaints += answers.breaches(journals, told, robots.names(session.ROBOTS))
        except answers.DamagedJournal as damage:
            point.complaints.append(f"damaged afterwards: {damage}")

    def what_a_kill_leaves(self):
        folder = bed.folder_of(self, self.folder)
        told = answers.Answers()
        server = bed.Server(folder).start()
        run = session.Session(server.target, told).run()
        server.kill()
        self.assertEqual(run.failures, [])
        return server.data, told

    def operations_of_a_recovery(self, left, told):
        folder = bed.folder_of(self, self.folder)
        bed.copy_of(left, folder / "data")
        server = bed.Server(folder, WAIT, environment=shim(folder)).start()
        self.assertEqual(session.kept_promises(server.target, told), [])
        server.stop()
        return counter(folder)[0]

    def recover_with_fault(self, point, left, told):
        folder = bed.folder_of(self, self.folder)
        bed.copy_of(left, folder / "data")
        server = bed.Server(folder, WAIT, environment=shim(folder, point.mode, point.at))
        try:
            if self.start(server, point):
                session.kept_promises(server.target, told, patience_s=RECOVERY_S)
                if server.alive():
                    server.process.send_signal(signal.SIGTERM)
                    server.process.wait(timeout=bed.PATIENCE_S)
        finally:
            code = server.kill()
        good = (0, 1, bed.EXIT_BY_FAULT) if point.started else (None, 1, bed.EXIT_BY_FAULT)
        self.complain_unless(code in good, point, f"exit code {code}: {server.log()}")
        point.fired = counter(folder)[1]
        self.judge_folder(server, point, told)

    def tell(self, when, count, points):
        fired = sum(point.fired > 0 for point in points)
        reasons = collections.Counter(f[2] or f[1].name for p in points for f in p.failures)
        refused = sum(not point.started for point in points)
        print(
            f"\n{when}: {count} operations; {len(points)} points, {fired} met; {refused} did not "
            f"start; calls that failed: {dict(reasons)}"
        )
        bad = [
            f"{point.mode} at {point.at}: {complaint}"
            for point in points
            for complaint in point.complaints
        ]
        self.assertEqual(bad, [])
        self.assertGreater(fired, len(points) * 0.8)


if __name__ == "__main__":
    bed.main()
