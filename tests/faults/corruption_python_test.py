# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""One bit of a data folder is flipped at a random place, or a file is cut off.

The server serves exactly what it served before, or says which mission or file is damaged; so does
whoever reads the journal. It never tells anything else.
"""

import collections
import time
import unittest

import grpc

import answers
import bed
import robots
import session
from plumescout.v1 import map_service_pb2 as map_pb
from plumescout.v1 import map_service_pb2_grpc as map_grpc
from plumescout.v1 import planning_service_pb2 as planning_pb

DAMAGES = {"ci": 100, "long": 2000}
CUT_EVERY = 10  # damages; the others are flips
QUIET_S = 0.5
MISSIONS = ("house", "cellar")


def fingerprint(target, mission):
    """All that can be read of a mission, or the reason why it cannot be."""
    with robots.Stubs(target) as stubs:
        maps = map_grpc.MapServiceStub(stubs.channel)
        request = map_pb.GetMapRequest(mission=f"missions/{mission}", full_precision=True)
        live = planning_pb.ListPlansRequest(mission=f"missions/{mission}")
        try:
            drawn = robots.await_answer(lambda: maps.GetMap(request, timeout=5.0))
            plans = stubs.planning.ListPlans(live, timeout=5.0)
        except grpc.RpcError as error:
            return (error.code().name, bed.reason_of(error), error.details())
    return drawn.SerializeToString(deterministic=True) + plans.SerializeToString(deterministic=True)


def files_of(data):
    """Files that hold something, and their sizes. What SQLite shares in memory (-shm) is made anew
    by whoever opens the database first."""
    found = [path for path in sorted(data.rglob("*")) if path.is_file()]
    return {p: p.stat().st_size for p in found if p.stat().st_size and not p.name.endswith("-shm")}


def state_of(data):
    return {path: (path.stat().st_size, path.stat().st_mtime_ns) for path in files_of(data)}


def await_quiet(data):
    """Returns once nothing was written to the folder for a while: what a server says of its own
    accord, after the last answer, is whole then, with the mark beside it that tells of its loss."""
    deadline = time.monotonic() + bed.PATIENCE_S
    state, since = state_of(data), time.monotonic()
    while time.monotonic() - since < QUIET_S:
        if time.monotonic() > deadline:
            raise AssertionError(f"{data} is written to for {bed.PATIENCE_S:g} s after the session")
        time.sleep(0.05)
        now = state_of(data)
        if now != state:
            state, since = now, time.monotonic()


class CorruptionTest(unittest.TestCase):
    def setUp(self):
        self.folder = bed.folder_of(self)

    def test_a_bit_is_flipped(self):
        self.left = {"killed": self.make(stop=False), "stopped": self.make(stop=True)}
        self.good = {name: self.look(data)[0] for name, data in self.left.items()}
        for seen in self.good.values():
            for mission in MISSIONS:
                self.assertIsInstance(seen[mission], bytes, seen[mission])
        self.events = {name: self.read_journal(data) for name, data in self.left.items()}
        damages = range(bed.size(DAMAGES["ci"], DAMAGES["long"]))
        outcomes = bed.two_at_a_time(self.damage_and_judge, damages)
        counts = collections.Counter(outcome for outcome, _ in outcomes)
        print(f"\n{len(damages)} damages: {dict(counts)}")
        self.assertEqual([bad for _, bad in outcomes if bad], [])

    def make(self, stop):
        folder = bed.folder_of(self, self.folder)
        server = bed.Server(folder).start()
        told = answers.Answers()
        run = session.Session(server.target, told).run()
        self.assertEqual(run.failures, [])
        await_quiet(server.data)
        server.stop() if stop else server.kill()
        return server.data

    def look(self, data):
        """Starts a server on a copy: ({mission: fingerprint}, None), or (None, why it ended)."""
        folder = bed.folder_of(self, self.folder)
        bed.copy_of(data, folder / "data")
        server = bed.Server(folder)
        try:
            server.start()
            seen = {mission: fingerprint(server.target, mission) for mission in MISSIONS}
            return seen, None
        except bed.DidNotStart as end:
            return None, end
        finally:
            server.kill()

    def read_journal(self, data):
        """What the reader tells of a copy; None if it calls it damaged."""
        folder = bed.folder_of(self, self.folder)
        try:
            return answers.read(bed.copy_of(data, folder / "data"))
        except answers.DamagedJournal:
            return None

    def damage(self, number):
        """Returns which folder was damaged, the damaged copy, and how."""
        chance = bed.random_of("damage", number)
        name = chance.choice(sorted(self.left))
        data = bed.copy_of(self.left[name], bed.folder_of(self, self.folder) / "damaged")
        files = files_of(data)
        if number % 4 == 0:  # small files too
            path = chance.choice(sorted(files))
        else:
            path = chance.choices(sorted(files), [files[p] for p in sorted(files)])[0]
        content = bytearray(path.read_bytes())
        place = chance.randrange(len(content))
        if number % CUT_EVERY == CUT_EVERY - 1:
            how = f"{path.name} cut off at {place} of {len(content)}"
            del content[place:]
        else:
            bit = chance.randrange(8)
            how = f"bit {bit} of byte {place} of {path.name} ({len(content)} bytes)"
            content[place] ^= 1 << bit
        path.write_bytes(content)
        return name, data, how

    def damage_and_judge(self, number):
        """(what came of it, or None and what is wrong)."""
        name, data, how = self.damage(number)
        how = f"{number} ({name}): {how}"
        events = self.read_journal(data)
        if events is not None and events != self.events[name]:
            return "wrong", f"{how}: the journal tells something else, without a complaint"
        seen, end = self.look(data)
        if end is not None:
            return ("refused", None) if end.says_why else ("wrong", f"{how}: {end}")
        harmless = True
        for mission, good in self.good[name].items():
            if seen[mission] == good:
                continue
            harmless = False
            if isinstance(seen[mission], bytes):
                return "wrong", f"{how}: {mission} is served otherwise than before"
            if seen[mission][1] not in ("STORE_DAMAGED", "STORE_UNAVAILABLE"):
                return "wrong", f"{how}: {mission}: {seen[mission]}"
        if not harmless:
            return "named by mission", None
        return ("harmless" if events is not None else "found by readers only"), None


if __name__ == "__main__":
    bed.main()
