# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""kill -9: eight robots stream, plan and report; the server is killed again and again.

After every kill the journal that it left has to hold what was acknowledged, each observation once.
"""

import time
import unittest

import answers
import bed
import robots

ROBOTS = 8
KILLS = {"ci": 30, "long": 1000}
KILLS_A_FOLDER = 50  # then begins another, so that journals do not grow beyond what is read soon
LIFE_S = (0.3, 1.5)  # of a server, uniformly; it may be killed while it recovers, but not
SETTLED = 0.7  # of the times: then it lives so long after all robots have gone on
MISSION = "house"


class KillTest(unittest.TestCase):
    def test_what_was_acknowledged_survives(self):
        left = bed.size(KILLS["ci"], KILLS["long"])
        sums = {"kills": 0, "durable": 0, "plans": 0, "reports": 0, "registered": 0}
        while left > 0:
            kills = min(left, KILLS_A_FOLDER)
            self.kill_again_and_again(kills, sums)
            left -= kills
        print(
            "\n{kills} kills: {durable} observations durable, {plans} plans, {reports} reports and "
            "{registered} leases answered; none lost, none twice".format(**sums)
        )

    def kill_again_and_again(self, kills, sums):
        folder = bed.folder_of(self)
        lives = bed.random_of("lives", sums["kills"])
        server = bed.Server(folder).start()
        self.addCleanup(server.kill)
        told = answers.Answers()
        with robots.Stubs(server.target) as stubs:
            robots.create_mission(stubs, MISSION, told, options=robots.cheap_options())
        team = [
            robots.Robot(server.target, MISSION, i, told, period_s=0.06) for i in range(ROBOTS)
        ]
        for robot in team:
            robot.start()
        try:
            journals = {}
            for _ in range(kills):
                if lives.random() < SETTLED:
                    self.await_progress(team)
                time.sleep(lives.uniform(*LIFE_S))
                self.assertTrue(server.alive(), server.log()[-3000:])
                server.kill()
                copy = bed.copy_of(server.data, folder / "copy")
                journals = answers.read(copy, journals)
                self.check(journals, told, team)
                server.start()
            self.await_progress(team)
        finally:
            for robot in team:
                robot.stop()
        server.stop()
        # Once more from the beginning: nothing that was read before has changed.
        whole = answers.read(server.data)
        self.check(whole, told, team)
        for robot, seen in journals[MISSION].observations.items():
            self.assertEqual(whole[MISSION].observations[robot][: len(seen)], seen)
        plans = journals[MISSION].plans
        self.assertEqual(whole[MISSION].plans[: len(plans)], plans)
        sums["kills"] += kills
        sums["durable"] += sum(robot.durable for robot in team)
        sums["plans"] += told.count("plan")
        sums["reports"] += told.count("report")
        sums["registered"] += told.count("registered")

    def check(self, journals, told, team):
        breaches = answers.breaches(journals, told, robots.names(ROBOTS))
        self.assertEqual(breaches, [])
        self.assertEqual([breach for robot in team for breach in robot.breaches], [])

    def await_progress(self, team):
        """All go on after the last kill."""
        before = [robot.durable for robot in team]
        bed.running.await_that(
            lambda: all(robot.durable > was for robot, was in zip(team, before)),
            "every robot's observations become durable",
        )


if __name__ == "__main__":
    bed.main()
