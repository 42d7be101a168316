// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Robots that join with a frame, that lose their place, and that correct their poses.

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/mission/conduct/mission_conduct.h"
#include "core/mission/mission.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/core/mission/corrected_mission.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_corrections_test {

using support::JumpAbout;
using support::kSecond_ns;
using support::RoomFrom;
using ::testing::HasSubstr;

class MissionCorrectionsTest : public support::CorrectedMission {
 protected:
  using CorrectedMission::CorrectedMission;
};

TEST_F(MissionCorrectionsTest, AFrameIsTakenOffWhatTheRobotSends) {
  const RobotFrame frame{{2.0, -1.0, 0.5}, 0.1, 0.01};
  RobotRegistered registration{"a", 0.2, 2};
  registration.frame = frame;
  const auto other = *Mission::Create({});
  const auto plain = *Mission::Create({});
  ASSERT_TRUE(other->Apply(registration).ok());
  ASSERT_TRUE(plain->Apply(RobotRegistered{"a", 0.2, 2}).ok());
  for (int step = 0; step < 20; ++step) {
    const Pose2 truth = TruthAt(step);
    const Scan scan = RoomFrom(truth);
    const Pose2 told = InRobot(frame, truth);
    ASSERT_TRUE(other->Apply(ObservationReceived{"a", {step + 1, TimeOf(step), told, scan}}).ok());
    ASSERT_TRUE(plain->Apply(ObservationReceived{"a", {step + 1, TimeOf(step), truth, scan}}).ok());
  }
  const RobotRecord a = other->Snapshot()->robots.at("a");
  const RobotRecord b = plain->Snapshot()->robots.at("a");
  EXPECT_NEAR(a.state.pose.x_m, b.state.pose.x_m, 1e-9);
  EXPECT_NEAR(a.state.pose.yaw_rad, b.state.pose.yaw_rad, 1e-9);
  EXPECT_NEAR(a.travelled_m, b.travelled_m, 1e-9);
  EXPECT_EQ(a.state.frame, frame);
  registration.lease_token = 3;
  registration.frame.mission_from_robot.x_m = NAN;
  EXPECT_THAT(std::string(other->Apply(registration).status().message()),
              HasSubstr("frame.mission_from_robot.x_m"));
  registration.frame.mission_from_robot.x_m = 1000.0;
  ASSERT_TRUE(other->Apply(registration).ok());
  const auto beyond =
      other->Apply(ObservationReceived{"a", {21, TimeOf(21), {5.0, 0, 0}, GasReading{1.0, 0.0}}});
  EXPECT_THAT(std::string(beyond->observation.message()), HasSubstr("in frame map"));
}

TEST_F(MissionCorrectionsTest, AJumpPutsTheRobotUnderSuspicionAndLeavesTheMapAsItWas) {
  Drive(100);
  const int walls = Occupied();
  const auto counters = conduct_->Snapshot()->gas_counters;
  const Pose2 jump = JumpAbout(TruthAt(step_), 0.6, 0.3, 0.1);
  Drive(50, jump);
  EXPECT_TRUE(State().frame_suspect);
  EXPECT_EQ(recorder_.suspicions, 1);
  EXPECT_EQ(Rebuilds().size(), 1u) << "without what came before it was noticed";
  EXPECT_NEAR(Occupied(), walls, walls / 20);
  EXPECT_EQ(conduct_->Snapshot()->gas_counters.readings, counters.readings);
  ExpectReplays();
}

TEST_F(MissionCorrectionsTest, ACorrectionBringsInWhatWasInQuarantine) {
  Drive(100);
  const int jumped = step_;
  const Pose2 jump = JumpAbout(TruthAt(step_), 1.2, -0.8, 0.35);
  Drive(80, jump);
  ASSERT_TRUE(State().frame_suspect);
  ASSERT_TRUE(Send(TimeOf(step_ - 1), TruthAt(step_ - 1), Back(jumped)).ok());
  EXPECT_FALSE(State().frame_suspect);
  EXPECT_EQ(conduct_->Snapshot()->gas_counters.readings, 36);
  const Pose2 end = State().pose;
  EXPECT_NEAR(Distance_m(end.position(), TruthAt(step_ - 1).position()), 0.0, 1e-9);
  Drive(30);
  EXPECT_FALSE(State().frame_suspect);
  EXPECT_EQ(Rebuilds().size(), 2u);
  ExpectReplays();

  // As if it had not happened.
  MissionConduct without(*Mission::Create({}));
  ASSERT_TRUE(without.Register(RobotRegistered{"a", 0.2, 1}).ok());
  std::int64_t sequence = 0;
  for (int step = 0; step < step_; ++step) {
    const Pose2 truth = TruthAt(step);
    std::vector<IncomingObservation> batch(1);
    batch[0].observation = {++sequence, TimeOf(step), truth, RoomFrom(truth)};
    if (step % 5 == 0) {
      batch.emplace_back().observation = {++sequence, TimeOf(step), truth,
                                          GasReading{10.0 * truth.x_m, 0.0}};
    }
    ASSERT_TRUE(without.Ingest("a", 1, std::move(batch)).status.ok());
  }
  const auto right = *without.FreshBelief();
  const auto mended = *conduct_->FreshBelief();
  EXPECT_EQ(mended->gas_counters, right->gas_counters);
  const Point2 end_m = TruthAt(step_ - 1).position();
  EXPECT_EQ(mended->sampled_cells->Nearest(end_m)->time_ns,
            right->sampled_cells->Nearest(end_m)->time_ns);
  int differ = 0;
  double worst_ppm = 0.0;
  for (std::size_t i = 0; i < right->occupancy->size(); ++i) {
    const Point2 at = right->geometry().Center(right->geometry().CellAtIndex(i));
    const Cell cell = mended->geometry().CellAt(at);
    const CellState state = mended->occupancy->At(cell, CellState::kUnknown);
    differ += state != (*right->occupancy)[i] ? 1 : 0;
    if (state != CellState::kFree || (*right->occupancy)[i] != CellState::kFree) continue;
    worst_ppm = std::max(worst_ppm, std::abs(static_cast<double>((*right->gas_mean_ppm)[i]) -
                                             static_cast<double>((*mended->gas_mean_ppm)[cell])));
  }
  EXPECT_LE(differ, 5);
  EXPECT_LT(worst_ppm, 0.5);
}

TEST_F(MissionCorrectionsTest, WhereARobotCameFromIsMovedWithItsWay) {
  Drive(20);
  ASSERT_EQ(conduct_->Snapshot()->robots.at("a").first_place, TruthAt(0).position());
  const auto moved = [this](int step) {
    const Pose2 truth = TruthAt(step);
    return Pose2{truth.x_m + 0.2, truth.y_m - 0.1, truth.yaw_rad};
  };
  const PoseCorrection all{{{TimeOf(0), moved(0)}, {TimeOf(step_ - 1), moved(step_ - 1)}}};
  ASSERT_TRUE(Send(TimeOf(step_ - 1), moved(step_ - 1), all).ok());
  const Point2 home = *conduct_->Snapshot()->robots.at("a").first_place;
  EXPECT_NEAR(Distance_m(home, moved(0).position()), 0.0, 1e-9);
  ExpectReplays();
}

TEST_F(MissionCorrectionsTest, ScansThatFitAgainEndTheSuspicionWithoutTheStretch) {
  Drive(100);
  const std::int64_t readings = conduct_->Snapshot()->gas_counters.readings;
  Drive(40, JumpAbout(TruthAt(step_), 0.8, 0.5, 0.2));
  ASSERT_TRUE(State().frame_suspect);
  Drive(20);
  EXPECT_TRUE(State().frame_suspect);
  Drive(30);
  EXPECT_FALSE(State().frame_suspect);
  EXPECT_LT(conduct_->Snapshot()->gas_counters.readings, readings + 8);
  ExpectReplays();
}

TEST_F(MissionCorrectionsTest, AnotherFrameEndsTheSuspicionTheSameDoesNot) {
  Drive(100);
  Drive(40, JumpAbout(TruthAt(step_), 0.8, 0.5, 0.2));
  ASSERT_TRUE(State().frame_suspect);
  RobotRegistered again{"a", 0.2, 2};
  ASSERT_TRUE(conduct_->Register(again).ok());
  EXPECT_TRUE(State().frame_suspect);
  again.lease_token = 3;
  again.frame.position_stddev_m = 0.3;  // the same frame, less well known
  ASSERT_TRUE(conduct_->Register(again).ok());
  EXPECT_TRUE(State().frame_suspect);
  again.lease_token = 4;
  again.frame.mission_from_robot = {0.1, 0.0, 0.0};
  ASSERT_TRUE(conduct_->Register(again).ok());
  EXPECT_FALSE(State().frame_suspect);
}

// Its clock is set forward by half a minute on the way; the anchors are of before.
TEST_F(MissionCorrectionsTest, AnchorsMeanWhatWasMeasuredThenWhateverTheClockShowsNow) {
  constexpr std::int64_t kSet_ns = 30 * kSecond_ns;
  Drive(60, {0.4, 0.0, 0.0});
  ASSERT_TRUE(conduct_->NoteClock({"a", -kSet_ns}, 1).ok());
  for (int i = 0; i < 40; ++i, ++step_) {
    const Pose2 truth = TruthAt(step_);
    ASSERT_TRUE(Send(TimeOf(step_) + kSet_ns, truth, GasReading{10.0 * truth.x_m, 0.0}).ok());
  }
  PoseCorrection correction;
  for (const int step : {0, 30, 59}) correction.anchors.push_back({TimeOf(step), TruthAt(step)});
  correction.anchors.push_back({TimeOf(60) + kSet_ns, TruthAt(60)});
  ASSERT_TRUE(Send(TimeOf(step_) + kSet_ns, TruthAt(step_), correction).ok());
  const auto belief = conduct_->Snapshot();
  const GridGeometry& geometry = belief->geometry();
  for (int step = 0; step < step_; step += step < 60 ? 5 : 1) {
    const Cell cell = geometry.CellAt(TruthAt(step).position());
    EXPECT_EQ((*belief->sampled)[cell], 1) << step;
  }
  ExpectReplays();
}

TEST_F(MissionCorrectionsTest, RefusalsNameFieldAndValueAndChangeNothing) {
  Drive(20);
  const auto before = conduct_->Snapshot()->gas_counters;
  const auto refuse = [&](const PoseCorrection& correction) {
    const absl::Status status = Send(TimeOf(step_), TruthAt(step_), correction);
    EXPECT_FALSE(status.ok());
    return std::string(status.message());
  };
  EXPECT_THAT(refuse({}), HasSubstr("correction has 0 anchors"));
  EXPECT_THAT(refuse({{{TimeOf(3), {}}, {TimeOf(2), {}}}}), HasSubstr("anchors[1].sample_time_ns"));
  EXPECT_THAT(refuse({{{TimeOf(3), {NAN, 0, 0}}}}), HasSubstr("anchors[0].pose.x_m"));
  EXPECT_THAT(refuse({{{TimeOf(step_ + 1), {}}}}), HasSubstr("must not be after"));
  EXPECT_THAT(refuse({{{5, {}}}}), HasSubstr("before the robot's first observation"));
  EXPECT_EQ(State().rejected_observations, 5);
  EXPECT_EQ(conduct_->Snapshot()->gas_counters, before);
  EXPECT_EQ(conduct_->mission().rebuild(), nullptr);
  EXPECT_FALSE(conduct_->mission().rebuild_due());
  EXPECT_TRUE(
      absl::IsFailedPrecondition(Mission::Create({}).value()->Apply(MapRebuilt{}).status()));
  ExpectReplays();
}

TEST_F(MissionCorrectionsTest, ASavedMissionGoesOnAsTheOneThatWasSaved) {
  Drive(100);
  const int jumped = step_;
  Drive(40, JumpAbout(TruthAt(step_), 1.0, 0.5, 0.2));
  ASSERT_TRUE(conduct_->BeginEpoch().ok());
  Drive(20, JumpAbout(TruthAt(jumped), 1.0, 0.5, 0.2));
  const Mission& mission = conduct_->mission();
  std::unique_ptr<Mission> replay = *Mission::Create({});
  std::unique_ptr<Mission> restored;
  std::size_t saved_at = 0;
  for (std::size_t i = 0; i < recorder_.events.size(); ++i) {
    ASSERT_TRUE(replay->Apply(recorder_.events[i]).ok());
    if (replay->rebuild() != nullptr) {
      EXPECT_FALSE(replay->can_be_saved());
    }
    if (!std::holds_alternative<EpochAdopted>(recorder_.events[i])) continue;
    if (!replay->can_be_saved()) continue;
    restored = *Mission::Restore({}, *replay->SaveState());
    saved_at = i + 1;
  }
  ASSERT_NE(restored, nullptr);
  ASSERT_TRUE(Send(TimeOf(step_ - 1), TruthAt(step_ - 1), Back(jumped)).ok());
  Drive(30);
  for (std::size_t i = saved_at; i < recorder_.events.size(); ++i) {
    ASSERT_TRUE(restored->Apply(recorder_.events[i]).ok());
  }
  EXPECT_EQ(restored->Digest(), mission.Digest());
  ExpectReplays();
}

class MissionInASmallWorld : public MissionCorrectionsTest {
 protected:
  static MissionOptions Options() {
    MissionOptions options;
    options.occupancy.max_extent_m = 20.0;
    return options;
  }
  MissionInASmallWorld() : MissionCorrectionsTest(Options()) {}
};

TEST_F(MissionInASmallWorld, ARebuiltMapWithoutRoomBesideTheOldOneIsToldOf) {
  Drive(20);
  const int walls = Occupied();
  const auto elsewhere = [this](int step) {
    const Pose2 truth = TruthAt(step);
    return Pose2{truth.x_m + 12.8, truth.y_m, truth.yaw_rad};
  };
  const int last = step_ - 1;
  const PoseCorrection all{{{TimeOf(0), elsewhere(0)}, {TimeOf(last), elsewhere(last)}}};
  ASSERT_TRUE(Send(TimeOf(last), elsewhere(last), all).ok());
  for (int i = 1; i <= 50; ++i) {
    ASSERT_TRUE(Send(TimeOf(last + i), elsewhere(last), GasReading{1.0, 0.0}).ok());
  }
  EXPECT_EQ(Rebuilds().size(), 1u);
  ASSERT_EQ(recorder_.kept_maps.size(), 1u);
  EXPECT_THAT(std::string(recorder_.kept_maps[0].message()), HasSubstr("max_extent_m"));
  EXPECT_EQ(Occupied(), walls);
  ExpectReplays();
}

class MissionWithoutScansKept : public MissionCorrectionsTest {
 protected:
  static MissionOptions Options() {
    MissionOptions options;
    options.keep_scans = false;
    return options;
  }
  MissionWithoutScansKept() : MissionCorrectionsTest(Options()) {}
};

TEST_F(MissionWithoutScansKept, RefusesCorrectionsAndDoubtsNobody) {
  Drive(50);
  Drive(20, JumpAbout(TruthAt(step_), 1.0, 0.5, 0.2));
  EXPECT_FALSE(State().frame_suspect);
  const absl::Status status = Send(TimeOf(step_ - 1), {}, Back(50));
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(status.message()), HasSubstr("keep_scans"));
}

}  // namespace mission_corrections_test
}  // namespace plumescout
