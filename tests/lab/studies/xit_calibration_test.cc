// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/studies/small_study.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace xit_calibration_test {

using ::testing::Contains;
using ::testing::Key;
using ::testing::SizeIs;

TEST(XitCalibration, ShowsTheBaselineAloneByRange) {
  const TempFolder folder;
  const auto study = RunXitCalibration(SmallStudy(folder));
  ASSERT_TRUE(study.ok()) << study.status();
  ASSERT_THAT(study->figures.tables, SizeIs(2));  // and calibration
  const TextTable& table = study->figures.tables.front();
  EXPECT_THAT(table.rows, SizeIs(6));
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  EXPECT_EQ(study->table.rows.front().front(), 1001.0) << "seeds that Table III has not";
  for (const char* range : {"range_30_dm", "range_80_dm"}) {
    EXPECT_THAT(study->summary.figures, Contains(Key(std::string(range) + "_rmse_ppm_mean")));
  }
}

}  // namespace xit_calibration_test
}  // namespace plumescout::lab
