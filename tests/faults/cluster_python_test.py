# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Three servers share a PostgreSQL behind two routers that see them differently, and are killed,
stopped for longer than their lease, cut from the database alone, from the routers alone, and
drained: what was acknowledged stands in the journals, once, and they replay."""

import unittest

import bed
import cluster

FAULTS = {"ci": cluster.KINDS * 2, "long": cluster.KINDS * 50}


class ClusterTest(unittest.TestCase):
    def test_no_fault_loses_doubles_or_forks_anything(self):
        chance = bed.random_of("cluster")
        running = cluster.Cluster(bed.folder_of(self), cluster.Shape(proxies=2))
        self.addCleanup(running.stop)
        try:
            for number, kind in enumerate(bed.size(FAULTS["ci"], FAULTS["long"])):
                mission = running.missions[number % len(running.missions)]
                node, rows = running.await_owner(mission)
                running.fault(kind, node, chance, rows)
            running.show()
        finally:
            running.stop_robots()
        breaches = running.breaches()
        print(running.summary(breaches))
        self.assertEqual(breaches, [])
        self.assertEqual(running.owner_faults, running.faults, "all hit who had missions under load")
        redirects = sum(robot.route.redirects for robot in running.team)
        self.assertGreater(redirects, 0, "the routers' lists lead to different nodes")


if __name__ == "__main__":
    bed.main()
