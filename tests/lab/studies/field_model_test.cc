// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/field_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/studies/small_study.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace field_model_test {

using ::testing::Contains;
using ::testing::Key;
using ::testing::SizeIs;

TEST(FieldModel, TellsOfEveryModelHowFarItIsFromTheTruth) {
  const TempFolder folder;
  const auto study = RunFieldModel(SmallStudy(folder));
  ASSERT_TRUE(study.ok()) << study.status();
  ASSERT_THAT(study->figures.tables, SizeIs(2));
  for (const TextTable& table : study->figures.tables) {
    EXPECT_THAT(table.rows, SizeIs(10));
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  }
  EXPECT_THAT(study->table.rows, SizeIs(3 * 10));  // two strategies, and as missions are
  EXPECT_THAT(study->table.labels, SizeIs(3 * 10));
  EXPECT_THAT(study->summary.figures,
              Contains(std::pair<std::string, double>("plain_rmse_ratio", 1.0)));
  EXPECT_THAT(study->summary.figures, Contains(Key("way_root_within_2_sigma")));
  EXPECT_THAT(study->summary.figures, Contains(Key("default_way_level_nlpd")));
}

}  // namespace field_model_test
}  // namespace plumescout::lab
