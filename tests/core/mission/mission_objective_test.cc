// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Missions that know what they are for.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "core/mission/mission.h"
#include "tests/support/box_room.h"

namespace plumescout {
namespace mission_objective_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

MissionOptions For(ObjectiveKind kind, double deadline_s = 0.0) {
  MissionOptions options;
  options.objective = {.kind = kind, .threshold_ppm = 10.0, .deadline_s = deadline_s};
  return options;
}

// A robot sweeps a room of 3 m x 3 m row by row and reads everywhere `air_ppm`.
class Sweep {
 public:
  explicit Sweep(const MissionOptions& options) : mission(Mission::Create(options).value()) {
    Apply(RobotRegistered{"a", 0.2, 1});
  }

  void Run(double air_ppm, int steps = 100) {
    for (int i = 0; i < steps; ++i) Step(air_ppm);
  }
  void Step(double air_ppm) {
    const int row = step_ / 10;
    const int column = row % 2 == 0 ? step_ % 10 : 9 - step_ % 10;
    const Pose2 pose{0.3 + 0.26 * column, 0.3 + 0.26 * (row % 10), 0.0};
    Send(pose, support::ScanInBox(pose, width_m, 3.0));
    Send(pose, GasReading{air_ppm});
    Apply(PosteriorRefreshed{time_ns_});
    ++step_;
    time_ns_ += kSecond_ns / 2;
  }
  void Complete(bool complete) {
    Plan plan;
    plan.robot = "a";
    plan.phase = complete ? MissionPhase::kComplete : MissionPhase::kExploring;
    plan.end = complete ? PlanEnd::kMissionComplete : PlanEnd::kNoGoals;
    plan.belief_revision = mission->revision();
    Apply(PlanIssued{plan});
  }
  ObjectiveStatus status() const { return mission->objective().value(); }
  void Apply(const EventBody& body) {
    const auto applied = mission->Apply(body);
    ASSERT_TRUE(applied.ok()) << applied.status();
    ASSERT_TRUE(applied->observation.ok()) << applied->observation;
  }

  std::unique_ptr<Mission> mission;
  double width_m = 3.0;  // of the room, from now on

 private:
  void Send(const Pose2& pose, ObservationPayload payload) {
    Apply(ObservationReceived{"a", {++sequence_, time_ns_, pose, std::move(payload)}});
  }

  int step_ = 0;
  std::int64_t sequence_ = 0;
  std::int64_t time_ns_ = 5 * kSecond_ns;
};

TEST(MissionObjective, CompleteMapsHaveNone) {
  Sweep sweep{MissionOptions()};
  sweep.Run(0.0, 3);
  EXPECT_FALSE(sweep.mission->objective().has_value());
  const auto belief = sweep.mission->Snapshot();
  EXPECT_FALSE(belief->objective.has_value());
  EXPECT_FALSE(belief->deadline_ns.has_value());
}

TEST(MissionObjective, CleanAirIsConfirmedOnceTheWholeRoomWasMeasured) {
  Sweep sweep(For(ObjectiveKind::kConfirmClean));
  sweep.Run(0.0, 10);
  EXPECT_EQ(sweep.status().state, ObjectiveState::kPursued);
  EXPECT_GT(sweep.status().undecided_area_m2, 1.0);
  sweep.Run(0.0, 95);
  EXPECT_EQ(sweep.status().state, ObjectiveState::kMet);
  EXPECT_GE(sweep.status().confidence, 0.95);
  EXPECT_GT(sweep.status().since_ns, 10 * kSecond_ns);
  EXPECT_EQ(*sweep.mission->Snapshot()->objective, sweep.status());
}

TEST(MissionObjective, WhatIsConcludedStays) {
  Sweep sweep(For(ObjectiveKind::kConfirmClean));
  sweep.Run(50.0, 10);
  const ObjectiveStatus refuted = sweep.status();
  ASSERT_EQ(refuted.state, ObjectiveState::kRefuted);
  sweep.Run(0.0, 50);
  EXPECT_EQ(sweep.status(), refuted);
  EXPECT_TRUE(IsOver(*sweep.mission->Snapshot()));
}

// A room twice as wide, of which the robot reads its half, and a door that is shut in its middle.
class HalfARoom : public Sweep {
 public:
  explicit HalfARoom(double hold_s) : Sweep(Holding(hold_s)) {
    Open(105);
    EXPECT_EQ(status().state, ObjectiveState::kPursued);
    EXPECT_GT(status().undecided_area_m2, 5.0);
  }
  void Open(int steps) {
    width_m = 6.0;
    Run(0.0, steps);
  }
  void Shut(int steps) {
    width_m = 3.0;
    Run(0.0, steps);
    EXPECT_EQ(status().undecided_area_m2, 0.0);
  }

 private:
  static MissionOptions Holding(double hold_s) {
    MissionOptions options = For(ObjectiveKind::kConfirmClean);
    options.objective.hold_s = hold_s;
    return options;
  }
};

TEST(MissionObjective, WhatHoldsForAMomentIsNoVerdict) {
  HalfARoom at_once(0.0);
  at_once.Shut(30);
  EXPECT_EQ(at_once.status().state, ObjectiveState::kMet);
  HalfARoom room(20.0);
  room.Shut(30);
  EXPECT_EQ(room.status().state, ObjectiveState::kPursued) << "for 15 s at most";
  room.Open(40);
  EXPECT_EQ(room.status().state, ObjectiveState::kPursued);
  EXPECT_GT(room.status().undecided_area_m2, 5.0);
  room.Shut(30);
  EXPECT_EQ(room.status().state, ObjectiveState::kPursued) << "counted from anew";
  room.Shut(40);
  EXPECT_EQ(room.status().state, ObjectiveState::kMet);
  room.Open(40);
  EXPECT_EQ(room.status().state, ObjectiveState::kMet) << "it has held";
}

TEST(MissionObjective, WithNothingLeftToDoAVerdictStandsAsLongAsItHolds) {
  HalfARoom room(100.0);
  room.Shut(30);
  room.Complete(true);
  EXPECT_EQ(room.status().state, ObjectiveState::kMet);
  room.Shut(4);
  EXPECT_EQ(room.status().state, ObjectiveState::kMet);
  room.Open(40);
  EXPECT_EQ(room.status().state, ObjectiveState::kCannotBeMet);
  room.Complete(false);
  EXPECT_EQ(room.status().state, ObjectiveState::kPursued);
}

TEST(MissionObjective, AMissionThatEndsWithoutCannotMeetItUntilItGoesOn) {
  Sweep sweep(For(ObjectiveKind::kConfirmClean));
  sweep.Run(0.0, 3);
  const std::int64_t before_ns = sweep.status().since_ns;
  sweep.Complete(true);
  EXPECT_EQ(sweep.status().state, ObjectiveState::kCannotBeMet);
  EXPECT_GT(sweep.status().since_ns, before_ns);
  sweep.Complete(false);
  EXPECT_EQ(sweep.status().state, ObjectiveState::kPursued);
}

TEST(MissionObjective, TheDeadlineCountsFromTheFirstObservation) {
  Sweep sweep(For(ObjectiveKind::kCompleteMap, 2.5));
  EXPECT_FALSE(sweep.mission->Snapshot()->deadline_ns.has_value());
  sweep.Run(0.0, 5);
  EXPECT_EQ(sweep.mission->Snapshot()->deadline_ns, 7 * kSecond_ns + kSecond_ns / 2);
  EXPECT_FALSE(IsOver(*sweep.mission->Snapshot()));
  sweep.Step(0.0);
  EXPECT_TRUE(IsOver(*sweep.mission->Snapshot()));
}

TEST(MissionObjective, RestoredMissionsKnowWhatTheyHaveReached) {
  const MissionOptions options = For(ObjectiveKind::kConfirmClean, 600.0);
  Sweep sweep(options);
  sweep.Run(0.0, 30);
  sweep.Apply(EpochBegun{30 * kSecond_ns});
  sweep.Apply(EpochAdopted{});
  const auto bytes = sweep.mission->SaveState();
  ASSERT_TRUE(bytes.ok()) << bytes.status();
  const auto restored = Mission::Restore(options, *bytes);
  ASSERT_TRUE(restored.ok()) << restored.status();
  EXPECT_EQ((*restored)->objective(), sweep.mission->objective());
  EXPECT_EQ((*restored)->Snapshot()->deadline_ns, sweep.mission->Snapshot()->deadline_ns);
  EXPECT_EQ((*restored)->Digest(), sweep.mission->Digest());
}

TEST(MissionObjective, TheDigestKnowsWhatWasReached) {
  Sweep without{MissionOptions()};
  Sweep with(For(ObjectiveKind::kConfirmClean));
  without.Run(0.0, 3);
  with.Run(0.0, 3);
  EXPECT_NE(without.mission->Digest(), with.mission->Digest());
}

TEST(MissionObjective, AGapOfNoTimeDoesNotBeginAMission) {
  constexpr std::int64_t kNow_ns = 1'700'000'000 * kSecond_ns;
  Mission mission(For(ObjectiveKind::kCompleteMap, /*deadline_s=*/600.0));
  const auto take = [&](const RobotId& robot, Observation observation) {
    const auto applied = mission.Apply(ObservationReceived{robot, std::move(observation)});
    ASSERT_TRUE(applied.ok() && applied->observation.ok());
  };
  for (const char* const robot : {"a", "b"}) {
    ASSERT_TRUE(mission.Apply(RobotRegistered{robot, 0.2, 1}).ok());
  }
  take("a", {1, 0, {}, SequenceGap{1, 5}});
  const Pose2 pose{1.5, 1.5, 0.0};
  take("a", {6, kNow_ns, pose, support::ScanInBox(pose, 3.0, 3.0)});
  const auto belief = mission.Snapshot();
  EXPECT_EQ(belief->deadline_ns, kNow_ns + 600 * kSecond_ns);
  EXPECT_FALSE(IsOver(*belief));
  EXPECT_FALSE(belief->robots.at("b").state.silent) << "it has had no time to send anything";
}

}  // namespace mission_objective_test
}  // namespace plumescout
