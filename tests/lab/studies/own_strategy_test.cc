// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/own_strategy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/studies/small_study.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace own_strategy_test {

using ::testing::Contains;
using ::testing::Key;
using ::testing::SizeIs;

TEST(OwnStrategy, ComparesAllContestantsWithTheOracle) {
  const TempFolder folder;
  const auto study = RunOwnStrategy(SmallStudy(folder));
  ASSERT_TRUE(study.ok()) << study.status();
  ASSERT_THAT(study->figures.tables, SizeIs(3));
  EXPECT_THAT(study->figures.tables[0].rows, SizeIs(7));  // six rows and the oracle
  EXPECT_THAT(study->figures.tables[1].rows, SizeIs(1));  // one building
  EXPECT_THAT(study->figures.tables[2].rows, SizeIs(6));  // calibration
  for (const TextTable& table : study->figures.tables) {
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  }
  EXPECT_THAT(study->table.rows, SizeIs(6));
  for (const char* figure :
       {"plumescout_entropy_oracle_share", "plumescout_rmse_oracle_share_low",
        "plumescout_rmse_oracle_share_high", "plumescout_default_rmse_oracle_share",
        "plumescout_default_rmse_best_share", "plumescout_default_within_2_sigma",
        "plumescout_default_worst_rmse_share", "plumescout_default_against_plumescout_rmse_p",
        "plumescout_against_xit_gff_rmse_p"}) {
    EXPECT_THAT(study->summary.figures, Contains(Key(figure)));
  }
  EXPECT_THAT(study->summary.figures,
              Contains(std::pair<std::string, double>("rrt_star_frontier_rmse_oracle_share", 0.0)));
}

}  // namespace own_strategy_test
}  // namespace plumescout::lab
