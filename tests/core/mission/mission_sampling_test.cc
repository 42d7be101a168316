// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Missions whose robots stop at sites and sample.
#include "core/mission/mission.h"

#include <vector>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/box_room.h"

namespace plumescout {
namespace mission_sampling_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::unique_ptr<Mission> MissionWith(std::initializer_list<const char*> robots,
                                     const MissionOptions& options = {}) {
  auto mission = Mission::Create(options);
  EXPECT_TRUE(mission.ok());
  for (const char* robot : robots)
    EXPECT_TRUE((*mission)->Apply(RobotRegistered{robot, 0.2, 1}).ok());
  return *std::move(mission);
}

// What readings were taken where, on whatever map there is.
std::vector<Point2> SampledPlaces(const Belief& belief) {
  std::vector<Point2> places;
  for (std::size_t i = 0; i < belief.sampled->size(); ++i) {
    if ((*belief.sampled)[i] == 0) continue;
    places.push_back(belief.geometry().Center(belief.geometry().CellAtIndex(i)));
  }
  return places;
}

TEST(MissionSampling, RemembersWhereReadingsWereTakenWhileTheMapGrows) {
  const auto mission = MissionWith({"a"});
  std::int64_t sequence = 0;
  const auto observe = [&](Pose2 pose, auto payload) {
    ++sequence;
    const auto applied =
        mission->Apply(ObservationReceived{"a", {sequence, sequence * kSecond_ns, pose, payload}});
    EXPECT_TRUE(applied.ok() && applied->observation.ok());
  };
  const Pose2 first{1.05, 1.05, 0.0};
  EXPECT_EQ(mission->Snapshot()->sampled->geometry(), mission->Snapshot()->geometry());
  observe(first, GasReading{1.0, 0.0});
  for (int k = 0; k < 3; ++k) observe(first, support::ScanInBox(first, 3.0, 3.0));
  const auto before = mission->Snapshot();
  EXPECT_EQ(before->sampled->geometry(), before->geometry());
  ASSERT_EQ(SampledPlaces(*before).size(), 1u) << "a reading from before there was a map";
  EXPECT_LT(Distance_m(SampledPlaces(*before)[0], first.position()), 1e-9);

  observe({2.05, 2.05, 0.0}, GasReading{1.0, 0.0});
  EXPECT_EQ(SampledPlaces(*mission->Snapshot()).size(), 2u) << "though the map did not change";
  EXPECT_EQ(mission->Snapshot()->sampled, mission->Snapshot()->sampled) << "shared";
  EXPECT_EQ(SampledPlaces(*before).size(), 1u) << "snapshots stay what they were";

  for (int k = 0; k < 3; ++k) observe(first, support::ScanInBox(first, 60.0, 60.0));
  const auto grown = mission->Snapshot();
  ASSERT_GT(grown->occupancy->size(), before->occupancy->size());
  EXPECT_EQ(grown->sampled->geometry(), grown->geometry());
  const std::vector<Point2> places = SampledPlaces(*grown);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_LT(Distance_m(places[0], {1.05, 1.05}), 1e-9);
  EXPECT_LT(Distance_m(places[1], {2.05, 2.05}), 1e-9);
}

TEST(MissionSampling, ARefusedReadingSamplesNothing) {
  const auto mission = MissionWith({"a"});
  const Pose2 pose{1.0, 1.0, 0.0};
  for (int k = 1; k <= 3; ++k) {
    ASSERT_TRUE(mission
                    ->Apply(ObservationReceived{
                        "a", {k, kSecond_ns, pose, support::ScanInBox(pose, 3.0, 3.0)}})
                    .ok());
  }
  ASSERT_TRUE(
      mission->Apply(ObservationReceived{"a", {4, kSecond_ns, pose, GasReading{-1.0, 0.0}}}).ok());
  EXPECT_TRUE(SampledPlaces(*mission->Snapshot()).empty());
}

TEST(MissionSampling, SaysWhenItsMapIsUpdatedNext) {
  const auto mission = MissionWith({"a"});
  EXPECT_FALSE(mission->next_map_update_ns().has_value());
  ASSERT_TRUE(
      mission->Apply(ObservationReceived{"a", {1, 5 * kSecond_ns, {1, 1, 0}, GasReading{1.0, 0.0}}})
          .ok());
  Plan plan;
  plan.robot = "a";
  Candidate& candidate = plan.candidates.emplace_back();
  candidate.goal.kind = GoalKind::kSite;
  plan.chosen = 0;
  plan.phase = MissionPhase::kSurvey;
  plan.trajectory.duration_s = 42.0;
  const auto issued = mission->Apply(PlanIssued{plan});
  ASSERT_TRUE(issued.ok()) << issued.status();
  EXPECT_EQ(mission->next_map_update_ns(), 47 * kSecond_ns);
  EXPECT_EQ(mission->Snapshot()->next_map_update_ns, 47 * kSecond_ns);
  EXPECT_EQ(mission->phase(), MissionPhase::kSurvey);
  ASSERT_TRUE(
      mission->Apply(ProgressReported{"a", issued->plan_id, ProgressOutcome::kReached}).ok());
  EXPECT_FALSE(mission->next_map_update_ns().has_value());
}

}  // namespace mission_sampling_test
}  // namespace plumescout
