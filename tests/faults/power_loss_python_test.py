# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Power fails: of what was written and not synced, any part is gone. What was acknowledged by then
survives.

The state of the disk is rebuilt from a trace of all that the server wrote and synced.
"""

import time
import unittest

import answers
import bed
import robots
import session
import write_trace

STATES = {"ci": 25, "long": 500}
STREAM_S = 2.0
MISSION = "hall"


class PowerLossTest(unittest.TestCase):
    def setUp(self):
        self.folder = bed.folder_of(self)

    def test_what_was_acknowledged_survives(self):
        told, trace = self.record()
        operations = write_trace.read(trace)
        ends = [operation.end for operation in operations]
        chance = bed.random_of("moments")
        moments = [chance.choice(ends) for _ in range(bed.size(STATES["ci"], STATES["long"]))]
        moments[-1] = ends[-1]  # one is the end
        found = bed.two_at_a_time(
            lambda item: self.check_state(operations, told, *item), list(enumerate(moments))
        )
        bad = [breach for breaches in found for breach in breaches]
        syncs = sum(operation.kind in "sd" for operation in operations)
        print(
            f"\n{len(operations)} operations, {syncs} of them syncs; {len(moments)} states; "
            f"{told.count('durable')} acknowledgements, {told.count('plan')} plans"
        )
        self.assertEqual(bad, [])

    def record(self):
        folder = bed.folder_of(self, self.folder)
        trace = folder / "trace"
        trace.touch()
        told = answers.Answers(mark=lambda: trace.stat().st_size)
        server = bed.Server(
            folder,
            environment={
                "LD_PRELOAD": str(bed.SHIM),
                "FAULT_FOLDER": str(folder / "data"),
                "FAULT_TRACE": str(trace),
            },
        ).start()
        try:
            run = session.Session(server.target, told).run()
            self.assertEqual(run.failures, [])
            self.stream(server, told)
        finally:
            server.kill()
        return told, trace

    def stream(self, server, told):
        with robots.Stubs(server.target) as stubs:
            robots.create_mission(stubs, MISSION, told)
        team = [robots.Robot(server.target, MISSION, i, told) for i in range(session.ROBOTS)]
        for robot in team:
            robot.start()
        time.sleep(STREAM_S)
        for robot in team:
            robot.stop()
        self.assertEqual([breach for robot in team for breach in robot.breaches], [])

    def check_state(self, operations, told, number, end):
        state = write_trace.state_at(operations, end, bed.random_of("state", number))
        folder = bed.folder_of(self, self.folder)
        write_trace.lay_down(state, folder / "data")
        name = f"state {number}, {end} bytes of the trace"
        server = bed.Server(folder)
        try:
            server.start()
            breaches = session.kept_promises(server.target, told, until=end)
            server.stop()
            journals = answers.read(server.data)
            breaches += answers.breaches(
                journals, told, robots.names(session.ROBOTS), until=end
            )
        except (bed.DidNotStart, answers.DamagedJournal) as damage:
            breaches = [str(damage)]
        finally:
            server.kill()
        return [f"{name}: {breach}" for breach in breaches]


if __name__ == "__main__":
    bed.main()
