# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Three servers share a PostgreSQL behind the shipped router, and are killed, stopped for longer than
their lease, and drained: what was acknowledged stands in the journals, once, and they replay."""

import unittest

import bed
import cluster

FAULTS = {"ci": ("kill", "pause", "roll", "kill"), "long": ("kill", "pause", "roll") * 70}


class ClusterTest(unittest.TestCase):
    def test_no_fault_loses_doubles_or_forks_anything(self):
        chance = bed.random_of("cluster")
        running = cluster.Cluster(bed.folder_of(self))
        self.addCleanup(running.stop)
        try:
            for number, kind in enumerate(bed.size(FAULTS["ci"], FAULTS["long"])):
                # Each node in turn, so that whoever took over is hit next.
                running.fault(kind, running.nodes[number % cluster.NODES], chance)
                running.await_progress()
            running.show()
        finally:
            running.stop_robots()
        breaches = running.breaches()
        print(running.summary(breaches))
        self.assertEqual(breaches, [])


if __name__ == "__main__":
    bed.main()
