// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_fig4.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plumescout::lab {
namespace xit_fig4_test {

ExperimentOptions Quick() {
  ExperimentOptions options;
  options.quick = true;
  return options;
}

// Columns of the table.
enum Column { kScene, kSystematic, kSamples, kRuns, kFound, kMean, kStddev, kLeast, kGreatest };

TEST(XitFig4, HasARowForEverySceneSamplingAndN) {
  const Study study = RunXitFig4(Quick()).value();
  EXPECT_EQ(study.figures.panels.size(), 3u);
  EXPECT_EQ(study.figures.charts.size(), 3u);
  EXPECT_EQ(study.table.rows.size(), 3u * 2u * 3u);
  for (const auto& row : study.table.rows) EXPECT_EQ(row.size(), study.table.columns.size());
}

TEST(XitFig4, PricesLieAboveTheBestAndFallWithMoreSamples) {
  const Study study = RunXitFig4(Quick()).value();
  double most = 0.0;
  for (const auto& row : study.table.rows) most = std::max(most, row[kSamples]);
  for (const auto& row : study.table.rows) {
    EXPECT_LE(row[kFound], row[kRuns]);
    if (row[kFound] == 0.0) continue;
    // Steps in 32 directions are at most 1.3 % longer than straight lines: 1 / cos(9.2 degrees).
    EXPECT_GT(row[kLeast], 0.98);
    EXPECT_LE(row[kLeast], row[kMean]);
    EXPECT_LE(row[kMean], row[kGreatest]);
    if (row[kSamples] < most) continue;
    EXPECT_EQ(row[kFound], row[kRuns]);
    EXPECT_LT(row[kMean], 1.35);
  }
}

TEST(XitFig4, TellsHowFarItIs) {
  ExperimentOptions options = Quick();
  double last = 0.0;
  options.progress = [&](double share) {
    EXPECT_GT(share, last);
    last = share;
  };
  ASSERT_TRUE(RunXitFig4(options).ok());
  EXPECT_DOUBLE_EQ(last, 1.0);
}

}  // namespace xit_fig4_test
}  // namespace plumescout::lab
