// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/lhr_table2.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace lhr_table2_test {

using ::testing::Contains;
using ::testing::Key;
using ::testing::SizeIs;

// One drive of each row takes some seconds.
TEST(LhrTable2, HasTheRowsOfThePaperAndSamplesEverySite) {
  const TempFolder folder;
  ExperimentOptions options;
  options.quick = true;
  options.jobs = 2;
  options.folder = folder.path();
  const auto study = RunLhrTable2(options);
  ASSERT_TRUE(study.ok()) << study.status();
  const TextTable& table = study->figures.tables.at(0);
  ASSERT_THAT(table.rows, SizeIs(6));
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  EXPECT_EQ(table.rows[2][2], "15547");  // [LHR] Table II
  EXPECT_EQ(table.rows[2][4], "46.7");
  const TextTable& bands = study->figures.tables.at(1);
  ASSERT_THAT(bands.rows, SizeIs(6));
  for (const auto& row : bands.rows) EXPECT_EQ(row.size(), bands.columns.size());
  EXPECT_EQ(bands.columns[4], "within 0.2 %");
  EXPECT_THAT(study->figures.charts, SizeIs(5));  // each row beside the sweep
  constexpr std::size_t kSamples = 2;             // column
  for (const auto& row : study->table.rows) EXPECT_EQ(row[kSamples], 51 * 51);
  EXPECT_THAT(study->figures.panels, SizeIs(6));  // the truth and five updates
  for (const char* row :
       {"sweep", "crs", "lhr_mean", "lhr_ucb", "lhr_mean_no_survey", "lhr_ucb_no_survey"}) {
    for (const char* figure : {"_distance_m", "_rmse_ct_min", "_within_2_sigma"}) {
      EXPECT_THAT(study->summary.figures, Contains(Key(std::string(row) + figure)));
    }
  }
  EXPECT_THAT(study->summary.figures, Contains(Key("p2_3003_subsets_ms")));
  EXPECT_THAT(study->summary.figures, Contains(Key("p1_6x6_ms")));
}

}  // namespace lhr_table2_test
}  // namespace plumescout::lab
