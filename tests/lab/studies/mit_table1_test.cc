// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/mit_table1.h"

#include <gtest/gtest.h>

#include <map>

#include "lab/worlds/mit_scene.h"
#include "tests/lab/studies/study_figures.h"

namespace plumescout::lab {
namespace mit_table1_test {

const Study& QuickStudy() {
  static const Study study = [] {
    ExperimentOptions options;
    options.quick = true;
    return RunMitTable1(options).value();
  }();
  return study;
}

double Figure(const std::string& name) { return FigureOf(QuickStudy(), name); }

TEST(MitTable1, HasARowForEveryRunOfEveryPlannerInEveryScene) {
  const double scenes = static_cast<double>(MitSceneVariants().size() + 2);
  EXPECT_EQ(Figure("scenes"), scenes);
  std::map<std::pair<double, double>, int> runs;
  for (const auto& row : QuickStudy().table.rows) {
    ASSERT_EQ(row.size(), QuickStudy().table.columns.size());
    ++runs[{row[0], row[1]}];
  }
  EXPECT_EQ(runs.size(), static_cast<std::size_t>(5.0 * scenes));
  for (const auto& [key, count] : runs) {
    const bool in_full = key.first == 0.0 || key.first == scenes - 1.0;  // table, narrow passage
    EXPECT_EQ(count, in_full ? 40 : 10);
  }
}

TEST(MitTable1, SharesAreThoseOfTheRuns) {
  int third = 0;
  int all = 0;
  for (const auto& row : QuickStudy().table.rows) {
    if (row[0] != 0.0 || row[1] != 0.0) continue;
    third += row[3] == 3.0 ? 1 : 0;
    ++all;
  }
  EXPECT_DOUBLE_EQ(Figure("scene_0_mit_share_3"), third / static_cast<double>(all));
  EXPECT_DOUBLE_EQ(Figure("mit_t3_percent"), 100.0 * third / static_cast<double>(all));
  EXPECT_EQ(Figure("trials"), all);
  EXPECT_GT(Figure("rrt_star_t3_percent"), 0.0);
}

// The bar of the table, with runs few enough for a share to err by 0.08 (one standard error).
TEST(MitTable1, MitFindsTheInformativeTrajectoryMoreOftenThanTheTrees) {
  EXPECT_GT(Figure("scene_0_mit_share_3"), 0.55);
  EXPECT_GT(Figure("scene_0_mit_share_3"), Figure("scene_0_rrt_star_share_3") + 0.15);
  EXPECT_GT(Figure("scene_0_mit_share_3"), Figure("scene_0_rrt_share_3") + 0.15);
}

// 250 runs each gave 39 % of MIT and none of even samples; the share of 40 runs errs by 8 % (one
// standard error).
TEST(MitTable1, OnlyInformedSamplesFindThePassage) {
  EXPECT_GT(Figure("passage_mit_through_percent"), 10.0);
  EXPECT_LT(Figure("passage_mit_even_through_percent"), 5.0);
}

TEST(MitTable1, ShowsTheSceneThePathsAndTheCharts) {
  EXPECT_EQ(QuickStudy().figures.panels.size(), 8u);
  EXPECT_EQ(QuickStudy().figures.bar_charts.size(), 3u);
  EXPECT_EQ(QuickStudy().figures.notes.size(), 5u);
}

TEST(MitTable1, TellsHowFarItIs) {
  ExperimentOptions options;
  options.quick = true;
  double last = 0.0;
  options.progress = [&](double share) {
    EXPECT_GT(share, last);
    last = share;
  };
  ASSERT_TRUE(RunMitTable1(options).ok());
  EXPECT_DOUBLE_EQ(last, 1.0);
}

}  // namespace mit_table1_test
}  // namespace plumescout::lab
