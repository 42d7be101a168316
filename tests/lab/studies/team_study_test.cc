// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/team_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

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
  ASSERT_THAT(study->figures.tables, SizeIs(3));
  EXPECT_THAT(study->figures.tables[0].rows, SizeIs(2));  // one robot and two
  EXPECT_THAT(study->figures.tables[1].rows, SizeIs(1));  // two: who is in whose way
  EXPECT_THAT(study->figures.tables[2].rows, SizeIs(2));  // calibration
  for (const TextTable& table : study->figures.tables) {
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  }
  EXPECT_THAT(study->table.rows, SizeIs(2));
  EXPECT_THAT(study->figures.panels, SizeIs(2));  // tubes, and ways
  EXPECT_THAT(study->figures.bar_charts, SizeIs(1));
  EXPECT_THAT(study->summary.figures, Contains(Key("given_k2_speedup_entropy80")));
  for (const char* name :
       {"contacts", "deadlocks_unresolved", "blocked_by_robot_share", "set_aside_by_robot",
        "promised_share", "bought_twice_share", "unseen_twice_share", "all_bought_twice_share",
        "plan_wall_ratio", "within_2_sigma"}) {
    EXPECT_THAT(study->summary.figures, Contains(Key(std::string("given_k2_") + name)));
  }
}

}  // namespace team_study_test
}  // namespace plumescout::lab
