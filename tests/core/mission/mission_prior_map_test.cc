// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Missions that know their building before the first scan.
#include <cmath>
#include <memory>

#include "core/mission/mission.h"
#include "core/plan/strategy.h"
#include "core/types/prior_map.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_prior_map_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// Free within walls of one cell; cells of `resolution_m`, its corner at (0,0).
Grid<CellState> Room(double resolution_m, int width, int height) {
  Grid<CellState> map({0.0, 0.0, resolution_m, width, height}, CellState::kOccupied);
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) map[Cell{x, y}] = CellState::kFree;
  }
  return map;
}

MissionOptions Knowing(Grid<CellState> map) {
  MissionOptions options;
  StartWith(std::make_shared<const Grid<CellState>>(std::move(map)), options);
  return options;
}

std::unique_ptr<Mission> MissionOfRobotA(const MissionOptions& options) {
  auto mission = Mission::Create(options);
  EXPECT_TRUE(mission.ok()) << mission.status();
  EXPECT_TRUE((*mission)->Apply(RobotRegistered{"a", 0.2, 1}).ok());
  return *std::move(mission);
}

absl::StatusOr<Plan> PlanFor(const Mission& mission, const std::string& strategy) {
  PlanningOptions planning = mission.options().planning;
  planning.strategy = strategy;
  EXPECT_TRUE(ApplyStrategyRow(planning).ok());
  const GridGeometry& known = mission.options().prior_map->geometry();
  planning.sites.spacing_m = known.resolution_m;
  planning.sites.region =
      Rectangle{{0.0, 0.0}, {known.width * known.resolution_m, known.height * known.resolution_m}};
  planning.sites.survey = false;
  planning.sites.update_period_s = 1e4;
  planning.dwell_s = 1.0;
  PlanRequest request;
  request.robot = "a";
  return (*MakeStrategy(planning))->Plan(*mission.Snapshot(), request, NeverStop());
}

TEST(MissionPriorMap, CellsAreKnownBeforeAnythingIsSensed) {
  const auto mission = MissionOfRobotA(Knowing(Room(0.1, 50, 40)));
  const auto belief = mission->Snapshot();
  const Grid<CellState>& known = *mission->options().prior_map;
  std::size_t free = 0;
  for (std::size_t i = 0; i < belief->occupancy->size(); ++i) {
    const Cell cell = belief->geometry().CellAtIndex(i);
    const Cell there = known.geometry().CellAt(belief->geometry().Center(cell));
    ASSERT_EQ((*belief->occupancy)[i], known.At(there, CellState::kUnknown));
    free += (*belief->occupancy)[i] == CellState::kFree ? 1U : 0U;
  }
  EXPECT_EQ(free, 48U * 38U);
  EXPECT_EQ((*belief->traversable)[belief->geometry().CellAt({2.5, 2.0})], 1);
}

TEST(MissionPriorMap, GasIsThePriorBeforeTheFirstReading) {
  const auto mission = MissionOfRobotA(Knowing(Room(0.1, 50, 40)));
  EXPECT_TRUE(mission->posterior_stale());
  const auto applied = mission->Apply(PosteriorRefreshed{mission->sample_time_ns()});
  ASSERT_TRUE(applied.ok()) << applied.status();
  EXPECT_TRUE(applied->posterior.ok()) << applied->posterior;
  const auto belief = mission->Snapshot();
  EXPECT_NE(belief->gas_what_if, nullptr);
  for (std::size_t i = 0; i < belief->occupancy->size(); ++i) {
    const bool free = (*belief->occupancy)[i] == CellState::kFree;
    ASSERT_EQ(std::isfinite((*belief->gas_variance_ppm2)[i]), free);
    if (!free) continue;
    ASSERT_GT((*belief->gas_variance_ppm2)[i], 0.0F);
    ASSERT_EQ((*belief->gas_mean_ppm)[i], 0.0F);
  }
}

TEST(MissionPriorMap, ARobotThatNeverScansIsSentToWhereReadingsTell) {
  constexpr std::int64_t kReadings = 10;  // in a row: enough cells for a gas frontier
  const auto mission = MissionOfRobotA(Knowing(Room(0.1, 80, 60)));
  for (std::int64_t sequence = 1; sequence <= kReadings; ++sequence) {
    const Pose2 pose{0.9 + 0.1 * static_cast<double>(sequence), 1.0, 0.0};
    const auto taken = mission->Apply(
        ObservationReceived{"a", {sequence, sequence * kSecond_ns, pose, GasReading{8.0, 0.0}}});
    ASSERT_TRUE(taken.ok() && taken->observation.ok());
  }
  ASSERT_TRUE(mission->Apply(PosteriorRefreshed{mission->sample_time_ns()}).ok());
  EXPECT_EQ(mission->Snapshot()->gas_counters.in_posterior, kReadings);
  for (const char* strategy : {"plumescout", "xit_gff"}) {
    const auto plan = PlanFor(*mission, strategy);
    ASSERT_TRUE(plan.ok()) << plan.status();
    ASSERT_GE(plan->chosen, 0) << strategy << ": " << plan->explanation;
    EXPECT_EQ(plan->phase, MissionPhase::kGasProbing) << strategy;
    EXPECT_GT(plan->trajectory.length_m, 0.0);
  }
}

TEST(MissionPriorMap, FrontiersAreWhereKnownFreeCellsMeetUnknownOnes) {
  Grid<CellState> map = Room(0.1, 60, 40);
  for (int y = 0; y < 40; ++y) map[Cell{59, y}] = CellState::kUnknown;  // the eastern wall
  const auto mission = MissionOfRobotA(Knowing(std::move(map)));
  const Pose2 pose{1.0, 2.0, 0.0};
  ASSERT_TRUE(
      mission->Apply(ObservationReceived{"a", {1, kSecond_ns, pose, GasReading{0.0, 0.0}}}).ok());
  const auto plan = PlanFor(*mission, "xit_f");
  ASSERT_TRUE(plan.ok()) << plan.status();
  ASSERT_GE(plan->chosen, 0) << plan->explanation;
  EXPECT_EQ(plan->phase, MissionPhase::kExploring);
  EXPECT_GT(plan->trajectory.waypoints.back().pose.x_m, 5.0);
}

TEST(MissionPriorMap, ScansChangeWhatWasKnown) {
  const MissionOptions options = Knowing(Room(0.1, 80, 40));  // in truth it ends at x = 4
  const auto mission = MissionOfRobotA(options);
  const Pose2 pose{2.0, 2.0, 0.0};
  const Scan scan = support::ScanInBox(pose, 4.0, 4.0);
  const auto state_at = [&](Point2 place) {
    const auto belief = mission->Snapshot();
    return (*belief->occupancy)[belief->geometry().CellAt(place)];
  };
  // From the clamp to tau_occ: ceil((3.5 + ln(0.65 / 0.35)) / 0.85) hits.
  constexpr std::int64_t kHits = 5;
  for (std::int64_t sequence = 1; sequence <= kHits; ++sequence) {
    EXPECT_EQ(state_at({4.02, 2.0}), CellState::kFree) << sequence;
    ASSERT_TRUE(
        mission->Apply(ObservationReceived{"a", {sequence, sequence * kSecond_ns, pose, scan}})
            .ok());
  }
  EXPECT_EQ(state_at({4.02, 2.0}), CellState::kOccupied);
  EXPECT_EQ(state_at({6.0, 2.0}), CellState::kFree) << "behind it";
}

TEST(MissionPriorMap, TheSameEventsGiveTheSameBytes) {
  const MissionOptions options = Knowing(Room(0.1, 50, 40));
  const auto original = MissionOfRobotA(options);
  const auto replay = MissionOfRobotA(options);
  const Pose2 pose{1.0, 1.0, 0.0};
  for (Mission* mission : {original.get(), replay.get()}) {
    ASSERT_TRUE(mission->Apply(PosteriorRefreshed{0}).ok());
    ASSERT_TRUE(
        mission->Apply(ObservationReceived{"a", {1, kSecond_ns, pose, GasReading{5.0, 0.0}}}).ok());
    ASSERT_TRUE(mission->Apply(PosteriorRefreshed{kSecond_ns}).ok());
  }
  EXPECT_TRUE(
      support::SameBytes(*original->Snapshot()->gas_mean_ppm, *replay->Snapshot()->gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*original->Snapshot()->gas_variance_ppm2,
                                 *replay->Snapshot()->gas_variance_ppm2));
}

TEST(MissionPriorMap, CellsOfThirteenMetresPlanLikeAnyOthers) {
  for (const double resolution_m : {13.0, 50.0}) {
    const auto mission = MissionOfRobotA(Knowing(Room(resolution_m, 68, 74)));
    const Pose2 pose{3.5 * resolution_m, 3.5 * resolution_m, 0.0};
    for (std::int64_t sequence = 1; sequence <= 2; ++sequence) {
      ASSERT_TRUE(mission
                      ->Apply(ObservationReceived{
                          "a", {sequence, sequence * kSecond_ns, pose, GasReading{9.0, 0.0}}})
                      .ok());
    }
    ASSERT_TRUE(mission->Apply(PosteriorRefreshed{mission->sample_time_ns()}).ok());
    for (const std::string& strategy : StrategyNames()) {
      if (strategy == "rrt_star_frontier") continue;  // its planner is not linked here
      const auto plan = PlanFor(*mission, strategy);
      ASSERT_TRUE(plan.ok()) << strategy << ": " << plan.status();
      if (plan->chosen < 0) continue;  // nothing to do for those who map the building
      ASSERT_FALSE(plan->trajectory.waypoints.empty()) << strategy;
      const auto issued = mission->Apply(PlanIssued{*plan});
      ASSERT_TRUE(issued.ok()) << issued.status();
      ASSERT_TRUE(
          mission->Apply(ProgressReported{"a", issued->plan_id, ProgressOutcome::kReached}).ok());
    }
    Scan scan{-M_PI, 0.1, 100.0, std::vector<float>(62, 60.0F)};
    ASSERT_TRUE(mission->Apply(ObservationReceived{"a", {3, 3 * kSecond_ns, pose, scan}}).ok());
    EXPECT_EQ(MakeMapSnapshot(*mission->Snapshot()).occupancy.geometry().resolution_m,
              resolution_m);
  }
}

TEST(MissionPriorMap, OneThatDoesNotFitMakesNoMission) {
  MissionOptions options;
  options.prior_map = std::make_shared<const Grid<CellState>>(Room(0.2, 10, 10));
  EXPECT_EQ(Mission::Create(options).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace mission_prior_map_test
}  // namespace plumescout
