// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/all_strategies.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/plan/strategy.h"
#include "tests/lab/studies/small_study.h"

namespace plumescout::lab {
namespace all_strategies_test {

using ::testing::Contains;
using ::testing::Gt;
using ::testing::Key;
using ::testing::Pair;
using ::testing::SizeIs;

TEST(AllStrategies, HasEveryStrategyWithTheMapUnknownAndKnown) {
  const TempFolder folder;
  const auto study = RunAllStrategies(SmallStudy(folder));
  ASSERT_TRUE(study.ok()) << study.status();
  const TextTable& table = study->figures.tables.at(0);
  ASSERT_THAT(table.rows, SizeIs(2 * StrategyNames().size()));
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    ASSERT_EQ(table.rows[i].size(), table.columns.size());
    EXPECT_EQ(table.rows[i][0], StrategyNames()[i / 2]);
    EXPECT_EQ(table.rows[i][1], i % 2 == 0 ? "unknown" : "known");
  }
  ASSERT_THAT(study->figures.bar_charts, SizeIs(2));
  EXPECT_THAT(study->figures.bar_charts[0].series, SizeIs(2));
  EXPECT_THAT(study->summary.figures, Contains(Pair("plumescout_kernel_dmv_rmse_share", Gt(0.0))));
  EXPECT_THAT(study->summary.figures, Contains(Key("lhr_known_entropy_nats")));
  EXPECT_THAT(study->summary.figures, Contains(Key("lhr_known_pooled_within_1_sigma")));
}

}  // namespace all_strategies_test
}  // namespace plumescout::lab
