// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_table3.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/lab/studies/small_study.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace xit_table3_test {

using ::testing::Contains;
using ::testing::Key;
using ::testing::SizeIs;

TEST(XitTable3, HasAllRowsWithThePapersValuesBeside) {
  const TempFolder folder;
  const auto study = RunXitTable3(SmallStudy(folder));
  ASSERT_TRUE(study.ok()) << study.status();
  // At the end; entropies; against the stronger baseline, which is not its own row; where the error
  // lies; calibration.
  ASSERT_THAT(study->figures.tables, SizeIs(5));
  for (const TextTable& table : study->figures.tables) {
    ASSERT_THAT(table.rows, SizeIs(&table == &study->figures.tables[2] ? 10 : 11));
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  }
  const TextTable& table = study->figures.tables.front();
  EXPECT_EQ(table.rows[5][5], "14.9 ± 1.9 (25.5 %)");  // [XIT] Table III
  EXPECT_EQ(table.rows[5][8], "957 ± 169 (23.7 %)");
  EXPECT_EQ(table.rows[0][4], "–");            // against itself
  EXPECT_THAT(study->table.rows, SizeIs(11));  // a trial each
  EXPECT_THAT(study->figures.panels, SizeIs(6));
  EXPECT_THAT(study->figures.charts, SizeIs(3));
  for (const Chart& chart : study->figures.charts) {
    const auto is_named = [](const Curve& curve) { return !curve.name.empty(); };
    EXPECT_EQ(std::count_if(chart.curves.begin(), chart.curves.end(), is_named), 6) << chart.title;
  }
  ASSERT_THAT(study->figures.bar_charts, SizeIs(2));
  EXPECT_THAT(study->figures.bar_charts.front().groups, SizeIs(11));
  std::vector<std::string> promised = {"trials"};
  for (const char* row : {"rrt_star_frontier", "xit_f_ucb", "xit_fgf_euclidean", "xit_fgf_ucb",
                          "xit_gff_euclidean", "xit_gff_ucb", "plumescout"}) {
    for (const char* figure :
         {"rmse_ppm_mean", "rmse_ppm_std", "entropy_mean", "entropy_std", "completeness_mean",
          "rmse_reduction_percent", "entropy_reduction_percent", "rmse_oracle_share",
          "entropy_oracle_share", "rmse_p_value", "entropy_p_value",
          "rmse_reduction_percent_low_95", "entropy_bp_per_cell_mean",
          "entropy_building_per_cell_mean", "within_1_sigma", "rms_z"}) {
      promised.push_back(std::string(row) + "_" + figure);
    }
  }
  for (const std::string& name : promised) {
    EXPECT_THAT(study->summary.figures, Contains(Key(name)));
  }
}

TEST(XitTable3, ReadsASceneBeforeAnythingRuns) {
  ExperimentOptions options;
  const TempFolder folder;
  options.folder = folder.path();
  options.scenes = {folder.File("nothing")};
  const absl::Status status = RunXitTable3(options).status();
  EXPECT_NE(status.message().find("nothing"), std::string::npos) << status;
}

}  // namespace xit_table3_test
}  // namespace plumescout::lab
