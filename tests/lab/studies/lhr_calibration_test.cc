// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/lhr_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace lhr_calibration_test {

using ::testing::Each;
using ::testing::IsSupersetOf;
using ::testing::Key;
using ::testing::SizeIs;

TEST(LhrCalibration, ComparesPairsWithThePaperAndSharesTheRowsThatBetaDoesNotChange) {
  const TempFolder folder;
  ExperimentOptions options;
  options.quick = true;
  options.jobs = 2;
  options.folder = folder.path();
  const auto study = RunLhrCalibration(options);
  ASSERT_TRUE(study.ok()) << study.status();
  const TextTable& table = study->figures.tables.at(0);
  ASSERT_THAT(table.rows, SizeIs(2));
  EXPECT_THAT(table.rows, Each(SizeIs(table.columns.size())));
  EXPECT_EQ(table.rows[0][2], table.rows[1][2]);  // LHR, mean
  EXPECT_NE(table.rows[0][3], table.rows[1][3]);  // LHR, UCB
  ASSERT_THAT(study->figures.key_numbers, SizeIs(2));
  EXPECT_EQ(study->figures.key_numbers[1].second, "2");
  EXPECT_THAT(study->table.rows, SizeIs(6));  // drives: two by the mean, four by UCB
  EXPECT_THAT(study->summary.figures,
              IsSupersetOf({Key("prior_5_beta_1_sum"), Key("prior_5_beta_2_sum"),
                            Key("lhr_mean_5_0_within_2_sigma")}));
}

}  // namespace lhr_calibration_test
}  // namespace plumescout::lab
