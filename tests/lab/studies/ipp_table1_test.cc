// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/ipp_table1.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
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
  ASSERT_THAT(study->figures.tables, SizeIs(3));  // 1 and 3 m/s, and calibration
  for (std::size_t speed = 0; speed < 2; ++speed) {
    const TextTable& table = study->figures.tables[speed];
    ASSERT_THAT(table.rows, SizeIs(6));
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
    EXPECT_EQ(table.rows[1][7], "N/A");  // [IPP] Table I
    EXPECT_EQ(table.rows[5][7], "2.05");
    EXPECT_EQ(table.rows[0][2], "1.00");  // of the sweep's own
  }
  EXPECT_THAT(study->table.rows, SizeIs(2 * 6 * 2));      // a drive of each from two starts
  EXPECT_THAT(study->figures.panels, SizeIs(4 + 5 * 4));  // five rows of four times
  EXPECT_THAT(study->figures.charts, SizeIs(2 * 5));
  const std::map<std::string, double> figures(study->summary.figures.begin(),
                                              study->summary.figures.end());
  for (const char* row : {"sweep", "uncertainty", "uncertainty_time", "uncertainty_concentration",
                          "concentration_time", "joint_uncertainty_concentration_time"}) {
    for (const std::string speed : {"", "_3mps"}) {
      const std::string name = row + speed;
      for (const char* figure :
           {"_final_rmse", "_min_rmse", "_samples", "_resolved", "_within_2_sigma"}) {
        ASSERT_THAT(figures, Contains(Key(name + figure)));
      }
      // What no drive came to was not measured.
      EXPECT_EQ(figures.contains(name + "_t_r_score"), figures.at(name + "_resolved") > 0) << name;
    }
  }
  EXPECT_EQ(figures.at("sweep_t_r_score"), 1.0);
}

}  // namespace ipp_table1_test
}  // namespace plumescout::lab
