// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_standing.h"

#include <gtest/gtest.h>

#include "core/types/error_reason.h"

namespace plumescout::server {
namespace mission_standing_test {

class MissionStandingTest : public testing::Test {
 protected:
  SteadyTime now_ = SteadyTime() + std::chrono::hours(1);
  MissionStanding standing_{"hall", [this] { return now_; }};
};

TEST_F(MissionStandingTest, APausedMissionTakesWritesAndPlansNothing) {
  EXPECT_TRUE(standing_.CheckMayPlan().ok());
  ASSERT_TRUE(standing_.Pause().ok());
  ASSERT_TRUE(standing_.Pause().ok());
  EXPECT_EQ(standing_.state(), MissionState::kPaused);
  EXPECT_TRUE(standing_.CheckMayWrite().ok());
  EXPECT_EQ(ErrorReason(standing_.CheckMayPlan()), reason::kMissionPaused);
  ASSERT_TRUE(standing_.Resume().ok());
  EXPECT_TRUE(standing_.CheckMayPlan().ok());
}

TEST_F(MissionStandingTest, AFinishedMissionStaysSo) {
  standing_.Finish();
  EXPECT_EQ(ErrorReason(standing_.CheckMayWrite()), reason::kMissionFinished);
  EXPECT_EQ(ErrorReason(standing_.CheckMayPlan()), reason::kMissionFinished);
  EXPECT_EQ(ErrorReason(standing_.Pause()), reason::kMissionFinished);
  EXPECT_EQ(ErrorReason(standing_.Resume()), reason::kMissionFinished);
  EXPECT_EQ(standing_.state(), MissionState::kFinished);
}

TEST_F(MissionStandingTest, ARecoveredMissionIsAsItWas) {
  EXPECT_EQ(standing_.event_retention(), EventRetention::kAll);
  standing_.Restore(MissionState::kPaused, absl::Seconds(5), EventRetention::kSinceSnapshot);
  EXPECT_EQ(standing_.event_retention(), EventRetention::kSinceSnapshot);
  EXPECT_EQ(standing_.state(), MissionState::kPaused);
  EXPECT_EQ(standing_.idle_time_to_live(), absl::Seconds(5));
}

TEST_F(MissionStandingTest, ItOutlivesItsUseByItsTimeToLive) {
  now_ += std::chrono::hours(10'000);
  EXPECT_FALSE(standing_.has_outlived_its_use());
  standing_.Touch();
  standing_.set_idle_time_to_live(absl::Seconds(5));
  now_ += std::chrono::milliseconds(4999);
  EXPECT_FALSE(standing_.has_outlived_its_use());
  standing_.Touch();
  now_ += std::chrono::milliseconds(4999);
  EXPECT_FALSE(standing_.has_outlived_its_use());
  now_ += std::chrono::milliseconds(1);
  EXPECT_TRUE(standing_.has_outlived_its_use());
  standing_.set_idle_time_to_live(absl::InfiniteDuration());
  EXPECT_FALSE(standing_.has_outlived_its_use());
}

}  // namespace mission_standing_test
}  // namespace plumescout::server
