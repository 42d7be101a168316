// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/team_rivals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/lab/studies/small_study.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace team_rivals_test {

using ::testing::Contains;
using ::testing::Key;
using ::testing::SizeIs;

TEST(TeamRivals, EveryRuleIsBesideOurs) {
  const TempFolder folder;
  const auto study = RunTeamRivals(SmallStudy(folder));
  ASSERT_TRUE(study.ok()) << study.status();
  ASSERT_THAT(study->figures.tables, SizeIs(3));
  EXPECT_THAT(study->figures.tables[0].rows, SizeIs(7));  // one robot, and two by six rules
  EXPECT_THAT(study->figures.tables[1].rows, SizeIs(6));
  EXPECT_THAT(study->figures.tables[2].rows, SizeIs(7));  // calibration
  EXPECT_THAT(study->table.rows, SizeIs(7));
  for (const char* row :
       {"k2", "k2_own_prices", "k2_own_ways", "k2_burgard", "k2_matching", "k2_rrt"}) {
    EXPECT_THAT(study->summary.figures,
                Contains(Key(std::string("given_") + row + "_speedup_entropy80")));
  }
}

}  // namespace team_rivals_test
}  // namespace plumescout::lab
