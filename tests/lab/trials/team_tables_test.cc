// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/team_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <utility>

namespace plumescout::lab {
namespace team_tables_test {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::DoubleEq;
using ::testing::Key;
using ::testing::Not;
using ::testing::Pair;
using ::testing::SizeIs;

// One building, one critical cell whose entropy falls from 10 to 0 nats in so long.
TrialRecord RunOf(double until_s) {
  TrialRecord record;
  for (int t = 0; t <= 100; t += 10) {
    MapMetrics metrics;
    const double done = std::min(1.0, t / until_s);
    metrics.completeness = done;
    metrics.rmse_ppm = 1.0 - done;
    metrics.entropy_nats = 10.0 * (1.0 - done);
    metrics.critical_cells = 1;
    record.curve.push_back({static_cast<double>(t), metrics});
  }
  return record;
}

SizeResult OneAndTwo() {
  SizeResult result;
  result.size = &kGivenBuildings;
  result.teams = {{.robots = 1, .name = "k1", .label = "one"},
                  {.robots = 2, .name = "k2", .label = "two"}};
  result.plan.scenes = {"hall"};
  result.plan.duration_s = 100.0;
  TrialRecord team = RunOf(50.0);
  team.team.contacts = 3;
  team.team.waiting_s = 10.0;
  team.team.robot_s = 200.0;
  result.records = {{{RunOf(100.0)}, {std::move(team)}}};
  return result;
}

TEST(TeamTables, TellHowMuchSoonerEachRowIs) {
  const TextTable table = SpeedTable(OneAndTwo());
  ASSERT_THAT(table.rows, SizeIs(2));
  for (const auto& row : table.rows) EXPECT_THAT(row, SizeIs(table.columns.size()));
  EXPECT_EQ(table.rows[0][1], "1.00");
  EXPECT_EQ(table.rows[1][0], "two");
  EXPECT_EQ(table.rows[1][1], "2.00") << "80 % at 80 s, and at 40 s";
}

TEST(TeamTables, OneRobotIsInNobodysWay) {
  const TextTable table = TrafficTable(OneAndTwo());
  ASSERT_THAT(table.rows, SizeIs(1));
  EXPECT_THAT(table.rows[0], SizeIs(table.columns.size()));
  EXPECT_EQ(table.rows[0][0], "two");
  EXPECT_EQ(table.rows[0][2], "3");
}

TEST(TeamTables, NumbersAreNamedBySizeAndRow) {
  Study study;
  AddNumbers(OneAndTwo(), study);
  EXPECT_THAT(study.summary.figures,
              AllOf(Contains(Pair("given_k2_speedup_entropy80", DoubleEq(2.0))),
                    Contains(Pair("given_k2_waiting_share", DoubleEq(0.05))),
                    Contains(Pair("given_k2_contacts", 3.0)),
                    Contains(Pair("given_k1_speedup_entropy80", 1.0))));
  EXPECT_THAT(study.summary.figures, Not(Contains(Key("given_k2_min_separation_m"))))
      << "nobody came near";
}

TEST(TeamTables, CalibrationIsNamedBySizeAndRow) {
  SizeResult result = OneAndTwo();
  result.plan.rows = {{"k1", {}}, {"k2", {}}};
  result.records[0][1][0].calibration.within_2_sigma = 0.5;
  result.records[0][1][0].calibration.estimated_cells = 4;
  Study study;
  AddCalibration(result, study);
  EXPECT_THAT(study.summary.figures, AllOf(Contains(Pair("given_k2_within_2_sigma", 0.5)),
                                           Contains(Key("given_k1_within_2_sigma"))));
}

TEST(TeamTables, PercentHasOneDecimal) { EXPECT_EQ(Percent(0.1234), "12.3 %"); }

}  // namespace team_tables_test
}  // namespace plumescout::lab
