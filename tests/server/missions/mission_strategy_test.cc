// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_strategy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace plumescout::server {
namespace mission_strategy_test {

using ::testing::HasSubstr;

TEST(MissionStrategy, RivalsAreMadeWhereTheyAreOnOnly) {
  for (const PathKind kind : {PathKind::kRrt, PathKind::kBitStar, PathKind::kPrmStar}) {
    PlanningOptions options;
    options.strategy = "xit_gff";
    ASSERT_TRUE(ApplyStrategyRow(options).ok());
    options.paths = kind;
    const auto off = MakeMissionStrategy(options, Rivals::kOff);
    EXPECT_TRUE(absl::IsInvalidArgument(off.status()));
    EXPECT_THAT(std::string(off.status().message()), HasSubstr("planning.paths"));
    if (HasRivals()) {
      EXPECT_TRUE(MakeMissionStrategy(options, Rivals::kOn).ok());
    }
  }
}

TEST(MissionStrategy, AServerThatIsBuiltWithoutRivalsCannotOfferThem) {
  EXPECT_TRUE(CheckRivals(true, true).ok());
  EXPECT_TRUE(CheckRivals(false, false).ok());
  const absl::Status refused = CheckRivals(true, false);
  EXPECT_TRUE(absl::IsInvalidArgument(refused));
  EXPECT_THAT(std::string(refused.message()), HasSubstr("planning.rivals = true"));
}

TEST(MissionStrategy, OursIsMadeEitherWay) {
  PlanningOptions options;
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  EXPECT_TRUE(MakeMissionStrategy(options, Rivals::kOff).ok());
}

}  // namespace mission_strategy_test
}  // namespace plumescout::server
