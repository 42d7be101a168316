// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_trial.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/lab/studies/study_figures.h"

namespace plumescout::lab {
namespace xit_trial_test {

const Study& QuickStudy() {
  static const Study study = [] {
    ExperimentOptions options;
    options.quick = true;
    auto result = RunXitTrial(options);
    EXPECT_TRUE(result.ok()) << result.status();
    return result.ok() ? *std::move(result) : Study{};
  }();
  return study;
}

double Figure(const std::string& name) { return FigureOf(QuickStudy(), name); }

TEST(XitTrial, TheRobotStopsToSample) {
  EXPECT_GT(Figure("stops"), 5.0);
  EXPECT_GE(Figure("readings"), Figure("stops"));
  // Four minutes at 0.15 m/s would be 36 m; stops of 5 s at every vertex leave far less.
  EXPECT_LT(Figure("distance_m"), 25.0);
  EXPECT_EQ(Figure("collisions"), 0.0);
}

TEST(XitTrial, ReadsGasOverTheAmbientAir) {
  EXPECT_GT(Figure("highest_estimate_ppm"), 600.0);
  EXPECT_LT(Figure("rmse_ppm"), Figure("rmse_clean_air_ppm"));
  EXPECT_GT(Figure("within_2_sigma"), 0.0) << "of ambient air and gas";
}

TEST(XitTrial, ItsPageSetsThePapersFiguresBeside) {
  const Study& study = QuickStudy();
  EXPECT_EQ(Figure("paper_duration_min"), 11.0);
  ASSERT_GE(study.figures.panels.size(), 4u);  // a row of Fig. 11, Fig. 12 and the truth at least
  EXPECT_EQ(study.figures.panels.size() % 2, 0u);
  EXPECT_EQ(study.figures.charts.size(), 3u);
  EXPECT_NE(study.figures.key_numbers.front().first.find("paper"), std::string::npos);
}

}  // namespace xit_trial_test
}  // namespace plumescout::lab
