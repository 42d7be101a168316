// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/cluster_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/lab/studies/study_figures.h"

namespace plumescout::lab {
namespace cluster_model_test {

const Study& Quick() {
  static const Study study = [] {
    ExperimentOptions options;
    options.quick = true;
    return RunClusterModel(options).value();
  }();
  return study;
}

double Figure(const std::string& name) { return FigureOf(Quick(), name); }

TEST(ClusterModel, MoreNodesRecoverTheMissionsOfOneSooner) {
  EXPECT_LT(Figure("storm_n10_m800_longest_s"), Figure("storm_n3_m800_longest_s") / 2.0);
  EXPECT_LT(Figure("storm_n100_m800_longest_s"), Figure("storm_n10_m800_longest_s"));
  EXPECT_GT(Figure("storm_n3_m800_median_s"), 10.0 * Figure("storm_n3_m10_median_s"));
}

TEST(ClusterModel, ShorterTailsMakeShorterStorms) {
  EXPECT_LT(Figure("tail_n3_0.1_s_longest_s"), Figure("tail_n3_2.0_s_longest_s") / 4.0);
  EXPECT_LT(Figure("tail_n3_0.1_s_longest_s"), 10.0);
}

TEST(ClusterModel, MoreRecoveriesAtATimeHelpWhereThereAreCores) {
  EXPECT_LT(Figure("recoveries_c16_k8_longest_s"), Figure("recoveries_c16_k1_longest_s") / 2.0);
  EXPECT_GT(Figure("recoveries_c2_k8_longest_s"), 0.7 * Figure("recoveries_c2_k1_longest_s"));
}

TEST(ClusterModel, RobotsWaitForTheLease) {
  EXPECT_GT(Figure("lease_5_s_median_s"), Figure("lease_1_s_median_s") + 2.0);
  EXPECT_GE(Figure("lease_1_s_median_s"), 0.75);
}

// 1 / (12 events/s * 0.78 ms) = 107 robots are a core.
TEST(ClusterModel, AMissionHasNoMoreRobotsThanACoreCanServe) {
  EXPECT_LE(Figure("hot_most_robots"), 107.0);
  EXPECT_GE(Figure("hot_most_robots"), 80.0);
  EXPECT_GT(Figure("hot_r128_p99_s"), 1.0);
}

TEST(ClusterModel, ShowsItAll) {
  EXPECT_EQ(Quick().figures.charts.size(), 6u);
  EXPECT_EQ(Quick().table.rows.size(), 3u * 7u + 3u * 6u + 3u * 4u + 15u);
  for (const auto& row : Quick().table.rows) EXPECT_EQ(row.size(), Quick().table.columns.size());
}

}  // namespace cluster_model_test
}  // namespace plumescout::lab
