// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Whether robots are judged for jumps while the map is rebuilt.

#include <memory>
#include <variant>

#include "core/mission/mission.h"
#include "gtest/gtest.h"
#include "tests/core/mission/corrected_mission.h"

namespace plumescout {
namespace mission_judging_test {

using support::JumpAbout;

class MissionJudgingTest : public support::CorrectedMission {
 protected:
  using CorrectedMission::CorrectedMission;
};

TEST_F(MissionJudgingTest, CorrectionsThatHardlyMoveAnythingLetRobotsBeJudged) {
  Drive(60);
  for (int second = 0; second < 4; ++second) {
    ASSERT_TRUE(Correct(Shift(0.01)).ok());
    Drive(10);
  }
  ASSERT_EQ(Rebuilds().size(), 1u) << "and the next is wanted";
  Drive(8, JumpAbout(TruthAt(step_), 0.8, 0.5, 0.2));
  EXPECT_TRUE(State().frame_suspect);
  EXPECT_EQ(Rebuilds().size(), 1u);
  ExpectReplays();
}

TEST_F(MissionJudgingTest, AMapThatMisleadsJudgesNobodyUntilItIsRebuilt) {
  Drive(60);
  ASSERT_TRUE(Correct(Shift(0.2)).ok());
  const Pose2 moved{0.2, 0.0, 0.0};
  Drive(8, Compose(moved, JumpAbout(TruthAt(step_), 0.8, 0.5, 0.2)));
  EXPECT_FALSE(State().frame_suspect);
  ASSERT_EQ(Rebuilds().size(), 0u);
  Drive(5, moved);
  ASSERT_EQ(Rebuilds().size(), 1u);
  Drive(15, Compose(moved, JumpAbout(TruthAt(step_), -0.7, 0.6, -0.3)));
  EXPECT_TRUE(State().frame_suspect);
  ExpectReplays();
}

TEST_F(MissionJudgingTest, ASavedMissionIsMisledByAsMuch) {
  Drive(60);
  ASSERT_TRUE(Correct(Shift(0.01)).ok());
  Drive(13);
  ASSERT_EQ(Rebuilds().size(), 1u);
  ASSERT_TRUE(Correct(Shift(0.01)).ok());
  ASSERT_TRUE(conduct_->BeginEpoch().ok());
  Drive(15);
  std::unique_ptr<Mission> replay = *Mission::Create({});
  std::unique_ptr<Mission> restored;
  for (const EventBody& body : recorder_.events) {
    if (restored != nullptr) {
      ASSERT_TRUE(restored->Apply(body).ok());
    }
    ASSERT_TRUE(replay->Apply(body).ok());
    const bool adopted = std::holds_alternative<EpochAdopted>(body);
    if (adopted && replay->can_be_saved()) restored = *Mission::Restore({}, *replay->SaveState());
  }
  ASSERT_NE(restored, nullptr);
  ASSERT_EQ(Rebuilds().size(), 1u) << "another is wanted";
  const std::size_t told = recorder_.events.size();
  Drive(8, JumpAbout(TruthAt(step_), 0.8, 0.5, 0.2));
  for (std::size_t i = told; i < recorder_.events.size(); ++i) {
    ASSERT_TRUE(restored->Apply(recorder_.events[i]).ok());
  }
  EXPECT_TRUE(restored->StateOf("a")->frame_suspect);
  EXPECT_EQ(restored->Digest(), conduct_->mission().Digest());
}

class MissionThatAnythingMisleads : public MissionJudgingTest {
 protected:
  static MissionOptions Options() {
    MissionOptions options;
    options.misleading_move_m = 0.0;
    return options;
  }
  MissionThatAnythingMisleads() : MissionJudgingTest(Options()) {}
};

TEST_F(MissionThatAnythingMisleads, JudgesNobodyWhileARebuildIsWanted) {
  Drive(60);
  ASSERT_TRUE(Correct(Shift(0.0)).ok());
  Drive(8, JumpAbout(TruthAt(step_), 0.8, 0.5, 0.2));
  EXPECT_FALSE(State().frame_suspect);
  EXPECT_EQ(Rebuilds().size(), 0u);
}

}  // namespace mission_judging_test
}  // namespace plumescout
