// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/pose_jump.h"

#include <cmath>

#include "gtest/gtest.h"

namespace plumescout::lab {
namespace pose_jump_test {

TEST(PoseJump, TurnsAboutWhereTheRobotStands) {
  PoseJump jump(PoseJumpOptions{1.0, 2.0, 0.0, M_PI / 2, std::nullopt});
  jump.Pass(0.5, 5, {3.0, 4.0, 0.0});
  EXPECT_EQ(jump.Told({3.0, 4.0, 0.0}), (Pose2{3.0, 4.0, 0.0}));
  jump.Pass(1.0, 10, {3.5, 4.0, 0.0});
  const Pose2 told = jump.Told({3.5, 4.0, 0.0});
  EXPECT_NEAR(told.x_m, 5.5, 1e-9);
  EXPECT_NEAR(told.y_m, 4.0, 1e-9);
  EXPECT_NEAR(told.yaw_rad, M_PI / 2, 1e-9);
  // A metre east is a metre north to it.
  EXPECT_NEAR(jump.Told({4.5, 4.0, 0.0}).y_m, 5.0, 1e-9);
  EXPECT_NEAR(jump.Held(told).x_m, 3.5, 1e-9);
  jump.Pass(100.0, 1000, {3.5, 4.0, 0.0});
  EXPECT_FALSE(jump.TakeCorrection().has_value());
}

TEST(PoseJump, IsCorrectedOnceInItsTime) {
  PoseJump jump(PoseJumpOptions{1.0, 2.0, 0.0, 0.3, 60.0});
  for (int t = 0; t < 70; ++t) jump.Pass(t, 10 * t, {0.1 * t, 0.0, 0.0});
  const auto correction = jump.TakeCorrection();
  ASSERT_TRUE(correction.has_value());
  EXPECT_EQ(correction->anchors,
            (std::vector<PoseAnchor>{
                {0, {0.0, 0.0, 0.0}}, {10, {0.1, 0.0, 0.0}}, {610, {0.1 * 61, 0.0, 0.0}}}));
  EXPECT_FALSE(jump.TakeCorrection().has_value());
  EXPECT_EQ(jump.Told({1.0, 1.0, 1.0}), (Pose2{1.0, 1.0, 1.0}));
}

TEST(PoseJump, NamesWhatIsOutOfRange) {
  EXPECT_TRUE(Validate(PoseJumpOptions{}).ok());
  EXPECT_FALSE(Validate(PoseJumpOptions{.at_s = -1.0}).ok());
  EXPECT_FALSE(Validate(PoseJumpOptions{.east_m = NAN}).ok());
  EXPECT_FALSE(Validate(PoseJumpOptions{.north_m = 101.0}).ok());
  EXPECT_FALSE(Validate(PoseJumpOptions{.turn_rad = 4.0}).ok());
  EXPECT_FALSE(Validate(PoseJumpOptions{.corrected_after_s = -1.0}).ok());
}

}  // namespace pose_jump_test
}  // namespace plumescout::lab
