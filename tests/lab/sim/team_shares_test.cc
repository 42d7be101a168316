// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/team_shares.h"

#include <gtest/gtest.h>

#include "tests/lab/sim/small_scene.h"

namespace plumescout::lab {
namespace team_shares_test {

EpisodeResult RobotAt(Point2 place, double time_s, std::int64_t readings, double distance_m) {
  EpisodeResult robot;
  robot.path = {{time_s, {place.x_m, place.y_m, 0.0}}};
  robot.readings_applied = readings;
  robot.distance_m = distance_m;
  return robot;
}

TEST(TeamShares, WhoSeesWhatWasSeenHasNoShareOfIt) {
  TeamResult team;
  team.robots = {RobotAt({0.65, 1.55}, 1.0, 30, 2.0), RobotAt({0.65, 1.55}, 0.0, 10, 6.0)};
  const std::vector<RobotShares> shares = SharesOf(team, SmallWorld(), 8.0);
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_EQ(shares[0].area, 0.0) << "it came later";
  EXPECT_EQ(shares[1].area, 1.0);
  EXPECT_EQ(shares[0].readings, 0.75);
  EXPECT_EQ(shares[1].readings, 0.25);
  EXPECT_EQ(shares[0].way, 0.25);
  EXPECT_EQ(shares[1].way, 0.75);
}

TEST(TeamShares, WhoLooksBehindTheBoxSeesSomethingNew) {
  TeamResult team;
  team.robots = {RobotAt({0.65, 1.55}, 0.0, 0, 0.0), RobotAt({3.35, 1.55}, 1.0, 0, 0.0)};
  const std::vector<RobotShares> shares = SharesOf(team, SmallWorld(), 8.0);
  EXPECT_GT(shares[1].area, 0.02);
  EXPECT_LT(shares[1].area, 0.5);
  EXPECT_DOUBLE_EQ(shares[0].area + shares[1].area, 1.0);
  EXPECT_EQ(shares[1].readings, 0.0) << "nobody read anything";
  EXPECT_EQ(shares[1].way, 0.0);
}

TEST(TeamShares, OfNobodyThereAreNone) { EXPECT_TRUE(SharesOf({}, SmallWorld(), 8.0).empty()); }

}  // namespace team_shares_test
}  // namespace plumescout::lab
