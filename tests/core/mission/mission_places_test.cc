// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Where robots of a mission may go: areas to keep out of, goals to come back to, and where they
// cannot have come to.
#include <memory>
#include <utility>

#include "absl/status/status.h"
#include "core/mission/mission.h"
#include "core/plan/strategy.h"
#include "gtest/gtest.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_places_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::unique_ptr<Mission> MissionOfRobotA(const MissionOptions& options = {}) {
  auto mission = Mission::Create(options);
  EXPECT_TRUE(mission.ok());
  EXPECT_TRUE((*mission)->Apply(RobotRegistered{"a", 0.2, 1}).ok());
  return *std::move(mission);
}

TEST(MissionPlaces, KeepsRobotsOutOfAreasThatItMapsAllTheSame) {
  MissionOptions options;
  options.keep_out = {{{{2.0, 1.0}, {3.0, 1.0}, {3.0, 2.0}, {2.0, 2.0}}}};
  const auto mission = MissionOfRobotA(options);
  const auto without = MissionOfRobotA();
  const Pose2 pose{1.0, 1.5, 0.0};
  for (Mission* each : {mission.get(), without.get()}) {
    for (std::int64_t sequence = 1; sequence <= 3; ++sequence) {
      const Scan scan = support::ScanInBox(pose, 4.0, 3.0);
      ASSERT_TRUE(
          each->Apply(ObservationReceived{"a", {sequence, sequence * kSecond_ns, pose, scan}})
              .ok());
    }
  }
  const auto belief = mission->Snapshot();
  const auto open = without->Snapshot();
  EXPECT_TRUE(support::SameBytes(*belief->occupancy, *open->occupancy));
  int closed = 0;
  for (std::size_t i = 0; i < belief->traversable->size(); ++i) {
    const Point2 at = belief->geometry().Center(belief->geometry().CellAtIndex(i));
    const bool inside = at.x_m > 2.0 && at.x_m < 3.0 && at.y_m > 1.0 && at.y_m < 2.0;
    const bool was_open = (*open->traversable)[i] != 0;
    EXPECT_EQ((*belief->traversable)[i] != 0, was_open && !inside);
    closed += was_open && inside ? 1 : 0;
  }
  EXPECT_EQ(closed, 100);
}

TEST(MissionPlaces, LeadsARobotInAKeepOutAreaOutOfIt) {
  MissionOptions options;
  options.keep_out = {{{{0.5, 0.5}, {1.8, 0.5}, {1.8, 2.5}, {0.5, 2.5}}}};
  options.home = Point2{3.0, 1.5};
  const auto mission = MissionOfRobotA(options);
  const Pose2 pose{1.0, 1.5, 0.0};
  for (std::int64_t sequence = 1; sequence <= 3; ++sequence) {
    const Scan scan = support::ScanInBox(pose, 4.0, 3.0);
    ASSERT_TRUE(
        mission->Apply(ObservationReceived{"a", {sequence, sequence * kSecond_ns, pose, scan}})
            .ok());
  }
  ASSERT_TRUE(mission->Apply(PosteriorRefreshed{3 * kSecond_ns}).ok());
  PlanRequest request;
  request.robot = "a";
  request.go_home = true;
  const auto plan = (*MakeStrategy({}))->Plan(*mission->Snapshot(), request, NeverStop());
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_TRUE(plan->start_escaped);
  ASSERT_GE(plan->chosen, 0);
  EXPECT_NEAR(plan->trajectory.waypoints.back().pose.x_m, 3.0, 0.1);
}

absl::Status ReadAt(Mission& mission, std::int64_t sequence, double time_s, double x_m,
                    ObservationPayload payload = GasReading{1.0, 0.0}) {
  const auto time_ns = static_cast<std::int64_t>(time_s * kSecond_ns);
  const auto applied = mission.Apply(
      ObservationReceived{"a", {sequence, time_ns, {x_m, 0.0, 0.0}, std::move(payload)}});
  return applied.ok() ? applied->observation : applied.status();
}

TEST(MissionPlaces, RefusesPosesFromWhichARobotCannotHaveCome) {
  const auto mission = MissionOfRobotA();
  ASSERT_TRUE(ReadAt(*mission, 1, 1.0, 1.0).ok());
  const auto readings = mission->Snapshot()->gas_counters.readings;
  const std::unique_ptr<Mission> restored = *Mission::Restore({}, *mission->SaveState());
  for (Mission* each : {mission.get(), restored.get()}) {
    const absl::Status status = ReadAt(*each, 2, 1.1, 40.0);
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    EXPECT_EQ(each->StateOf("a")->pose.x_m, 1.0);
    EXPECT_EQ(each->StateOf("a")->rejected_observations, 1);
    EXPECT_EQ(each->Snapshot()->gas_counters.readings, readings);
  }
  EXPECT_TRUE(ReadAt(*mission, 3, 1.2, 1.5).ok());
  EXPECT_TRUE(ReadAt(*mission, 4, 4.0, 40.0).ok()) << "it had the time";
  MissionOptions options;
  options.max_robot_speed_mps = 0.0;
  const auto anywhere = MissionOfRobotA(options);
  EXPECT_TRUE(ReadAt(*anywhere, 1, 1.0, 1.0).ok());
  EXPECT_TRUE(ReadAt(*anywhere, 2, 1.1, 900.0).ok());
}

TEST(MissionPlaces, WhoCorrectsItsPosesOrRegistersAgainMayBeAnywhere) {
  const auto mission = MissionOfRobotA();
  ASSERT_TRUE(ReadAt(*mission, 1, 1.0, 1.0).ok());
  ASSERT_TRUE(
      ReadAt(*mission, 2, 1.1, 90.0, PoseCorrection{{{kSecond_ns, {90.0, 0.0, 0.0}}}}).ok());
  EXPECT_TRUE(ReadAt(*mission, 3, 1.2, 90.5).ok());
  EXPECT_FALSE(ReadAt(*mission, 4, 1.3, 1.5).ok());
  ASSERT_TRUE(mission->Apply(RobotRegistered{"a", 0.2, 2}).ok());
  EXPECT_TRUE(ReadAt(*mission, 5, 1.4, 1.5).ok());
  EXPECT_FALSE(ReadAt(*mission, 6, 1.5, 90.5).ok());
}

TEST(MissionPlaces, ForgetsThatAGoalWasBlockedWhenTheMapThereChanges) {
  const auto mission = MissionOfRobotA();
  std::int64_t sequence = 0;
  const auto scan = [&](const Scan& taken) {
    ++sequence;
    const std::int64_t now_ns = sequence * kSecond_ns / 10;
    const Pose2 pose{1.0, 1.5, 0.0};
    ASSERT_TRUE(mission->Apply(ObservationReceived{"a", {sequence, now_ns, pose, taken}}).ok());
  };
  const Pose2 pose{1.0, 1.5, 0.0};
  for (int i = 0; i < 20; ++i) scan(support::ScanInBox(pose, 4.0, 3.0));
  Plan plan;
  plan.robot = "a";
  plan.candidates = {Candidate{}};
  plan.candidates[0].goal.position = {3.0, 1.5};
  plan.chosen = 0;
  const auto issued = mission->Apply(PlanIssued{plan});
  ASSERT_TRUE(issued.ok());
  ASSERT_TRUE(
      mission->Apply(ProgressReported{"a", issued->plan_id, ProgressOutcome::kBlocked}).ok());
  for (int i = 0; i < 20; ++i) scan(support::ScanInBox(pose, 4.0, 3.0));
  EXPECT_EQ(mission->Snapshot()->set_aside.size(), 1u) << "the same room, scanned again";
  // A pillar stands there now.
  for (int i = 0; i < 40; ++i) scan(support::ScanInBox(pose, 4.0, 3.0, {{{3.0, 1.5}, 0.6}}));
  EXPECT_TRUE(mission->Snapshot()->set_aside.empty());
}

TEST(MissionPlaces, DoesNotSetAsideAGoalThatARobotStoodBefore) {
  const auto mission = MissionOfRobotA();
  ASSERT_TRUE(mission->Apply(RobotRegistered{"b", 0.2, 1}).ok());
  const Pose2 pose{1.0, 1.5, 0.0};
  const Scan room = support::ScanInBox(pose, 4.0, 3.0);
  ASSERT_TRUE(mission->Apply(ObservationReceived{"a", {1, kSecond_ns, pose, room}}).ok());
  const auto end = [&](ProgressOutcome outcome) {
    Plan plan;
    plan.robot = "a";
    plan.candidates = {Candidate{}};
    plan.candidates[0].goal.position = {3.0, 1.5};
    plan.chosen = 0;
    const auto issued = mission->Apply(PlanIssued{plan});
    ASSERT_TRUE(issued.ok()) << issued.status();
    ASSERT_TRUE(mission->Apply(ProgressReported{"a", issued->plan_id, outcome}).ok());
  };
  const auto put_b = [&](std::int64_t sequence, double x_m) {
    const Observation there{sequence, kSecond_ns, {x_m, 1.5, 0.0}, GasReading{1.0, 0.0}};
    ASSERT_TRUE(mission->Apply(ObservationReceived{"b", there}).ok());
  };
  put_b(1, 2.8);  // 1.8 m away: two radii of 0.2 m and 1.4 m
  end(ProgressOutcome::kBlocked);
  EXPECT_TRUE(mission->Snapshot()->set_aside.empty());
  end(ProgressOutcome::kReached);
  end(ProgressOutcome::kReached);
  EXPECT_EQ(mission->Snapshot()->set_aside.size(), 1u) << "visited twice without change";
  put_b(2, 3.0);
  end(ProgressOutcome::kBlocked);
  EXPECT_EQ(mission->Snapshot()->set_aside.size(), 2u) << "b is far enough away";
}

}  // namespace mission_places_test
}  // namespace plumescout
