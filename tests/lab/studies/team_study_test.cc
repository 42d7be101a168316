// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/team_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/studies/small_study.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace team_study_test {

using ::testing::Contains;
using ::testing::Key;
using ::testing::SizeIs;

TEST(TeamStudy, ComparesTeamsWithOneRobot) {
  const TempFolder folder;
  const auto study = RunTeamStudy(SmallStudy(folder));
  ASSERT_TRUE(study.ok()) << study.status();
  ASSERT_THAT(study->figures.tables, SizeIs(1));
  ASSERT_THAT(study->figures.tables[0].rows, SizeIs(2));  // one robot and two
  for (const auto& row : study->figures.tables[0].rows) {
    EXPECT_EQ(row.size(), study->figures.tables[0].columns.size());
  }
  EXPECT_THAT(study->table.rows, SizeIs(2));
  EXPECT_THAT(study->summary.figures, Contains(Key("given_k2_speedup_entropy80")));
  EXPECT_THAT(study->summary.figures, Contains(Key("given_k2_contacts")));
}

}  // namespace team_study_test
}  // namespace plumescout::lab
