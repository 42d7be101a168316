// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_fig3.h"

#include <gtest/gtest.h>

#include <map>

namespace plumescout::lab {
namespace xit_fig3_test {

const Study& QuickStudy() {
  static const Study study = [] {
    ExperimentOptions options;
    options.quick = true;
    return RunXitFig3(options).value();
  }();
  return study;
}

// Columns of the table.
enum Column { kAlpha, kXitLength, kXitRatio, kXitInformation, kExactLength, kExactRatio };

TEST(XitFig3, ShowsThePapersThreeValuesAndTheChange) {
  EXPECT_EQ(QuickStudy().figures.panels.size(), 4u);
  const std::map<std::string, double> figures(QuickStudy().summary.figures.begin(),
                                              QuickStudy().summary.figures.end());
  EXPECT_EQ(figures.at("alpha_0_alpha_per_m"), 0.0);
  EXPECT_EQ(figures.at("alpha_0.005_alpha_per_m"), 0.005);
  EXPECT_EQ(figures.at("alpha_1_alpha_per_m"), 1.0);
  // A metre without information costs 10: the weight that undoes a detour is of that order.
  EXPECT_GT(figures.at("half_way_alpha_per_m"), 1.0);
  EXPECT_LT(figures.at("half_way_alpha_per_m"), 100.0);
}

// The samples are the same for every alpha, and so is the graph, in which each tree path is the
// best: as alpha rises, the length of the best can only fall.
TEST(XitFig3, TheTreesPathNeverGetsLongerAsAlphaRises) {
  const auto& rows = QuickStudy().table.rows;
  ASSERT_GT(rows.size(), 5u);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_GT(rows[i][kAlpha], rows[i - 1][kAlpha]);
    EXPECT_LE(rows[i][kXitLength], rows[i - 1][kXitLength] + 1e-9);
  }
}

TEST(XitFig3, InformationIsGivenUpForLength) {
  const auto& rows = QuickStudy().table.rows;
  EXPECT_LT(rows.back()[kXitInformation], 0.7 * rows.front()[kXitInformation]);
  EXPECT_GT(rows.front()[kExactRatio], 1.1);
  EXPECT_NEAR(rows.back()[kExactRatio], 1.0, 0.02);  // alpha = 1000: the shortest way
}

TEST(XitFig3, TellsHowFarItIs) {
  ExperimentOptions options;
  options.quick = true;
  double last = -1.0;
  options.progress = [&](double share) {
    EXPECT_GT(share, last);
    EXPECT_LT(share, 1.0);
    last = share;
  };
  ASSERT_TRUE(RunXitFig3(options).ok());
  EXPECT_GT(last, 0.5);
}

}  // namespace xit_fig3_test
}  // namespace plumescout::lab
