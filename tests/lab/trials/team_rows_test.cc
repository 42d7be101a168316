// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/team_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/lab/studies/small_study.h"

namespace plumescout::lab {
namespace team_rows_test {

using ::testing::ElementsAre;

TEST(TeamRows, OursDriveByTheDefaultStrategy) {
  const auto row = MakeStudyRow({.robots = 4,
                                 .yields = false,
                                 .anticipates = false,
                                 .name = "k4",
                                 .most_late_s = 1.5,
                                 .balanced_areas = true});
  ASSERT_TRUE(row.ok()) << row.status();
  EXPECT_EQ(row->mission.planning.strategy, "plumescout");
  EXPECT_FALSE(row->mission.planning.yield_to_robots);
  EXPECT_FALSE(row->mission.planning.anticipate_robots);
  EXPECT_TRUE(row->mission.planning.balanced_areas);
  EXPECT_EQ(row->robots, 4);
  EXPECT_EQ(row->most_late_s, 1.5);
  EXPECT_FALSE(row->rule);
}

TEST(TeamRows, ThoseOfARuleDriveToFrontiersByTheShortestWay) {
  const auto row = MakeStudyRow({.robots = 2, .name = "k2_matching", .rule = TeamRule::kMatching});
  ASSERT_TRUE(row.ok()) << row.status();
  const PlanningOptions& planning = row->mission.planning;
  EXPECT_EQ(planning.goal_policy, GoalPolicy::kOccupancyOnly);
  EXPECT_EQ(planning.paths, PathKind::kGridExact);
  EXPECT_EQ(planning.cost, CostKind::kEuclidean);
  EXPECT_EQ(planning.selection_rule, SelectionRule::kLeastCost);
  EXPECT_TRUE(planning.yield_to_robots);
  EXPECT_EQ(row->rule, TeamRule::kMatching);
}

TEST(RunSizes, ProgressIsOfAllTogether) {
  const TempFolder folder;
  ExperimentOptions options = SmallStudy(folder);
  std::vector<double> shares;
  options.progress = [&](double share) { shares.push_back(share); };
  const SizeToRun size = {&kGivenBuildings, {{.robots = 1, .name = "k1", .label = "one"}}, 5.0};
  std::vector<std::size_t> told;
  ASSERT_TRUE(RunSizes(options, {size, size}, [&](const SizeResult& result) {
                told.push_back(result.records.size());
                return absl::OkStatus();
              }).ok());
  EXPECT_THAT(told, ElementsAre(1u, 1u));
  ASSERT_FALSE(shares.empty());
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_DOUBLE_EQ(shares.back(), 1.0);
}

TEST(RunSizes, EndsWithWhatOneIsTold) {
  const TempFolder folder;
  const ExperimentOptions options = SmallStudy(folder);
  const SizeToRun size = {&kGivenBuildings, {{.robots = 1, .name = "k1", .label = "one"}}, 5.0};
  int told = 0;
  const absl::Status status = RunSizes(options, {size, size}, [&](const SizeResult&) {
    ++told;
    return absl::InternalError("enough");
  });
  EXPECT_EQ(status.message(), "enough");
  EXPECT_EQ(told, 1);
}

}  // namespace team_rows_test
}  // namespace plumescout::lab
