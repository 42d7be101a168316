// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/objectives.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/studies/small_study.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace objectives_test {

using ::testing::Contains;
using ::testing::Key;
using ::testing::SizeIs;

TEST(Objectives, TellsOfEveryMissionWhenItStopsAndWhetherItIsRight) {
  const TempFolder folder;
  const auto study = RunObjectives(SmallStudy(folder));
  ASSERT_TRUE(study.ok()) << study.status();
  ASSERT_THAT(study->figures.tables, SizeIs(2));  // and calibration
  EXPECT_THAT(study->figures.tables[0].rows, SizeIs(8));
  for (const auto& row : study->figures.tables[0].rows) {
    EXPECT_EQ(row.size(), study->figures.tables[0].columns.size());
  }
  EXPECT_THAT(study->table.rows, SizeIs(8));
  EXPECT_THAT(study->summary.figures,
              Contains(std::pair<std::string, double>("complete_map_time_share", 1.0)));
  EXPECT_THAT(study->summary.figures, Contains(Key("confirm_clean_right")));
  EXPECT_THAT(study->summary.figures, Contains(Key("deadline_home")));
  EXPECT_THAT(study->summary.figures, Contains(Key("deadline_within_2_sigma")));
  EXPECT_THAT(study->figures.tables[1].rows, SizeIs(5)) << "where something leaks";
}

}  // namespace objectives_test
}  // namespace plumescout::lab
