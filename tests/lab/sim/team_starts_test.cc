// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/team_starts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/sim/small_scene.h"

namespace plumescout::lab {
namespace team_starts_test {

using ::testing::ElementsAre;

constexpr double kBody_m = 0.1;

TEST(TeamStartsTest, TheFirstStartsWhereTheSceneSays) {
  const auto starts = TeamStarts(SmallWorld(), 1, kBody_m);
  ASSERT_TRUE(starts.ok()) << starts.status();
  EXPECT_THAT(*starts, ElementsAre(SmallWorld().scene().start_pose));
}

TEST(TeamStartsTest, TheOthersKeepTheirDistance) {
  const auto starts = TeamStarts(SmallWorld(), 4, kBody_m);
  ASSERT_TRUE(starts.ok()) << starts.status();
  ASSERT_EQ(starts->size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_FALSE(SmallWorld().Collides((*starts)[i].position(), kBody_m)) << i;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(Distance_m((*starts)[i].position(), (*starts)[j].position()), kStartSpacing_m);
    }
  }
  EXPECT_LT(Distance_m((*starts)[1].position(), (*starts)[0].position()), 2.0 * kStartSpacing_m);
}

TEST(TeamStartsTest, SaysIfThereIsNoRoom) {
  const absl::Status status = TeamStarts(SmallWorld(), 32, kBody_m).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_NE(status.message().find("robots = 32"), absl::string_view::npos) << status;
}

TEST(TeamStartsTest, NamesCountOnFromTheFirst) {
  EXPECT_THAT(TeamNames("robot-1", 3), ElementsAre("robot-1", "robot-2", "robot-3"));
  EXPECT_THAT(TeamNames("scout9", 2), ElementsAre("scout9", "scout10"));
  EXPECT_THAT(TeamNames("scout", 2), ElementsAre("scout", "scout-2"));
  EXPECT_THAT(TeamNames("scout", 1), ElementsAre("scout"));
}

}  // namespace team_starts_test
}  // namespace plumescout::lab
