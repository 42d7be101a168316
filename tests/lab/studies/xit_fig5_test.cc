// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_fig5.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace plumescout::lab {
namespace xit_fig5_test {

using ::testing::HasSubstr;

const Study& OneStudy() {
  static const Study study = RunXitFig5({}).value();
  return study;
}

TEST(XitFig5, ShowsThreeStepsUnderBothScopesBesideTheGas) {
  ASSERT_EQ(OneStudy().figures.panels.size(), 8u);
  EXPECT_THAT(OneStudy().figures.panels[1].title, HasSubstr("(a) everywhere"));
  EXPECT_THAT(OneStudy().figures.panels[7].title, HasSubstr("(c) Alg. 2"));
  EXPECT_EQ(OneStudy().figures.charts.size(), 3u);
}

TEST(XitFig5, CountsTheFrontiersOfTheCaption) {
  const std::map<std::string, double> figures(OneStudy().summary.figures.begin(),
                                              OneStudy().summary.figures.end());
  EXPECT_EQ(figures.at("everywhere_a_gas_frontiers"), 2.0);
  EXPECT_EQ(figures.at("everywhere_b_gas_frontiers"), 1.0);
  EXPECT_GE(figures.at("everywhere_c_gas_frontiers"), 1.0);
  EXPECT_EQ(figures.at("local_b_gas_frontiers"), 0.0);
  EXPECT_LT(figures.at("everywhere_b_mean_at_robot_ppm"), figures.at("everywhere_b_threshold_ppm"));
}

TEST(XitFig5, SaysThatTheAlgorithmAsPrintedForgets) {
  EXPECT_THAT(OneStudy().figures.notes.back(), HasSubstr("forgets the other frontier"));
}

TEST(XitFig5, HasARowForEveryReadingOfBothWalks) {
  int local = 0;
  for (const auto& row : OneStudy().table.rows) {
    ASSERT_EQ(row.size(), OneStudy().table.columns.size());
    local += row[0] == 1.0 ? 1 : 0;
  }
  EXPECT_GT(local, 8);
  EXPECT_GT(static_cast<int>(OneStudy().table.rows.size()) - local, 8);
}

}  // namespace xit_fig5_test
}  // namespace plumescout::lab
