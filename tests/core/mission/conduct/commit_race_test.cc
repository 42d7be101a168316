// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/commit_race.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace commit_race_test {

TEST(CommitRace, ALostRaceIsRunAgainThreeTimes) {
  CommitRace race;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(race.SearchAgainAfter(absl::AbortedError("claimed")));
  EXPECT_FALSE(race.SearchAgainAfter(absl::AbortedError("claimed")));
}

TEST(CommitRace, NothingElseIsWorthAnotherSearch) {
  CommitRace race;
  EXPECT_FALSE(race.SearchAgainAfter(absl::OkStatus()));
  EXPECT_FALSE(race.SearchAgainAfter(absl::FailedPreconditionError("LEASE_SUPERSEDED: gone")));
  EXPECT_TRUE(race.SearchAgainAfter(absl::AbortedError("claimed")));
}

}  // namespace commit_race_test
}  // namespace plumescout
