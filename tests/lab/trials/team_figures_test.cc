// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/team_figures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace team_figures_test {

// A run of one critical cell whose entropy, error and map are 10 - t/10, 8 - t/20 and t/100, by a
// clock that goes so many times faster, until 100 s.
TrialRecord RunOf(double faster) {
  TrialRecord record;
  for (int t = 0; t <= 100; t += 5) {
    const double then = std::min(100.0, faster * t);
    MapMetrics metrics;
    metrics.completeness = then / 100.0;
    metrics.rmse_ppm = 8.0 - then / 20.0;
    metrics.entropy_nats = 10.0 - then / 10.0;
    metrics.critical_cells = 1;
    record.curve.push_back({static_cast<double>(t), metrics});
  }
  return record;
}

TEST(TeamFigures, SpeedupIsOfTimesToLevels) {
  const std::vector<SceneRecords> records = {{{RunOf(1.0)}, {RunOf(2.0)}},
                                             {{RunOf(1.0)}, {RunOf(2.0)}}};
  const Speedup speedup = SpeedupOf(records, 1, 0);
  EXPECT_DOUBLE_EQ(speedup.entropy, 80.0 / 40.0);
  EXPECT_DOUBLE_EQ(speedup.rmse, 80.0 / 40.0);
  EXPECT_DOUBLE_EQ(speedup.map, 95.0 / 50.0) << "at 47.5 s, known at 50 s";
  EXPECT_DOUBLE_EQ(speedup.half_rmse, 80.0 / 40.0);
  EXPECT_EQ(speedup.censored, 0);
}

TEST(TeamFigures, RunsThatDoNotGetThereAreCounted) {
  const std::vector<SceneRecords> records = {{{RunOf(1.0)}, {RunOf(0.5)}}};
  const Speedup speedup = SpeedupOf(records, 1, 0);
  EXPECT_EQ(speedup.censored, 1);
  EXPECT_DOUBLE_EQ(speedup.map, 95.0 / 100.0) << "it counts with its end";
  EXPECT_EQ(speedup.pairs, 1);
  EXPECT_EQ(speedup.map_pairs, 0);
}

TEST(TeamFigures, PairsOfWhichEitherDoesNotGetThereAreTold) {
  // By 100 s the slow ones know half of the map, and have 5.5 ppm of 8 left.
  const std::vector<SceneRecords> records = {
      {{RunOf(1.0)}, {RunOf(2.0)}}, {{RunOf(0.5)}, {RunOf(1.0)}}, {{RunOf(1.0)}, {RunOf(0.5)}}};
  const Speedup speedup = SpeedupOf(records, 1, 0);
  EXPECT_EQ(speedup.pairs, 3);
  EXPECT_EQ(speedup.map_pairs, 1);
  EXPECT_EQ(speedup.half_rmse_pairs, 1);
}

TEST(TeamFigures, TrafficIsSummed) {
  TrialRecord first;
  first.team = {.legs = 8,
                .blocked_legs = 4,
                .contacts = 1,
                .encounters = 3,
                .closest_m = 0.5,
                .waiting_s = 12.0,
                .robot_s = 60.0,
                .plan_wall_s = 0.02,
                .findings = {}};
  first.team.findings = {.blocked_by_robot = 2,
                         .set_aside_for_robot = 1,
                         .deadlocks = 2,
                         .held_up = 3,
                         .alone_nats = 6.0,
                         .besides_nats = 5.0,
                         .paid_nats = 3.0,
                         .paid_twice_nats = 1.0,
                         .unseen_goals = 3,
                         .unseen_in_others_sight = 1,
                         .unseen_paid_nats = 8.0,
                         .unseen_paid_twice_nats = 2.0};
  TrialRecord second;
  second.team = {.legs = 2,
                 .blocked_legs = 1,
                 .contacts = 0,
                 .encounters = 0,
                 .closest_m = 0.4,
                 .waiting_s = 0.0,
                 .robot_s = 60.0,
                 .plan_wall_s = 0.04,
                 .findings = {}};
  second.team.findings.alone_nats = 4.0;
  second.team.findings.besides_nats = 3.0;
  second.team.findings.paid_nats = 1.0;
  second.team.findings.unseen_goals = 1;
  second.team.findings.unseen_paid_nats = 4.0;
  const SceneRecords unmeasured(1, {TrialRecord()});  // of one robot, or of ghosts
  EXPECT_EQ(TrafficOf({unmeasured}, 0).sums.closest_m, std::nullopt);
  const std::vector<SceneRecords> records = {{{first}}, {{second}}};
  const Traffic traffic = TrafficOf(records, 0);
  EXPECT_EQ(traffic.missions, 2);
  EXPECT_EQ(traffic.deadlocked_missions, 1);
  EXPECT_EQ(traffic.sums.contacts, 1);
  EXPECT_EQ(traffic.sums.closest_m, 0.4);
  EXPECT_EQ(traffic.sums.findings.set_aside_for_robot, 1);
  EXPECT_EQ(traffic.sums.findings.deadlocks, 2);
  EXPECT_EQ(traffic.sums.findings.held_up, 3);
  EXPECT_DOUBLE_EQ(traffic.blocked_share(), 0.5);
  EXPECT_DOUBLE_EQ(traffic.blocked_by_robot_share(), 0.2);
  EXPECT_DOUBLE_EQ(traffic.encounters_per_robot_minute(), 1.5);
  EXPECT_DOUBLE_EQ(traffic.waiting_share(), 0.1);
  EXPECT_DOUBLE_EQ(traffic.promised_share(), 0.2);
  EXPECT_DOUBLE_EQ(traffic.bought_twice_share(), 0.25);
  EXPECT_DOUBLE_EQ(traffic.unseen_twice_share(), 0.25);
  EXPECT_DOUBLE_EQ(traffic.all_bought_twice_share(), 3.0 / 16.0);
  EXPECT_DOUBLE_EQ(traffic.plan_wall_s, 0.03);
}

}  // namespace team_figures_test
}  // namespace plumescout::lab
