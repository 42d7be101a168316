// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/ipp_table1.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace ipp_table1_test {

using ::testing::Contains;
using ::testing::Key;
using ::testing::SizeIs;

TEST(IppTable1, HasTheRowsOfThePaper) {
  const TempFolder folder;
  ExperimentOptions options;
  options.quick = true;
  options.trials = 1;
  options.jobs = 2;
  options.folder = folder.path();
  const auto study = RunIppTable1(options);
  ASSERT_TRUE(study.ok()) << study.status();
  const TextTable& table = study->figures.tables.at(0);
  ASSERT_THAT(table.rows, SizeIs(7));  // and a sweep of ours
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  EXPECT_EQ(table.rows[1][6], "N/A");  // [IPP] Table I
  EXPECT_EQ(table.rows[5][6], "2.05");
  EXPECT_EQ(table.rows[0][2], "1.00");            // of the sweep's own
  EXPECT_THAT(study->table.rows, SizeIs(7));      // a drive each
  EXPECT_THAT(study->figures.panels, SizeIs(5));  // the truth, and two of two rows
  for (const char* row : {"sweep", "uncertainty", "uncertainty_time", "uncertainty_concentration",
                          "concentration_time", "joint_uncertainty_concentration_time"}) {
    for (const char* figure : {"_final_rmse", "_min_rmse", "_t_r_score", "_samples"}) {
      EXPECT_THAT(study->summary.figures, Contains(Key(std::string(row) + figure)));
    }
  }
}

}  // namespace ipp_table1_test
}  // namespace plumescout::lab
