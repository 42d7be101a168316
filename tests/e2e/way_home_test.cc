// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Missions with limits on where robots may drive, how far and how fast.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lab/local/local_planner_client.h"
#include "tests/e2e/hall_run.h"

namespace plumescout::lab {
namespace way_home_test {

EpisodeResult Drive(const EpisodeOptions& options) {
  LocalPlannerClient planner;
  const absl::StatusOr<HallRun> run = RunInHall(planner, options);
  EXPECT_TRUE(run.ok()) << run.status();
  return run.ok() ? run->episode : EpisodeResult{};
}

bool HasPhase(const EpisodeResult& episode, MissionPhase phase) {
  return std::any_of(episode.plans.begin(), episode.plans.end(),
                     [phase](const IssuedPlan& issued) { return issued.plan.phase == phase; });
}

TEST(WayHomeTest, ARobotWithATravelBudgetIsHomeBeforeItIsSpent) {
  EpisodeOptions options = HallOptions();
  options.duration_s = 120.0;
  constexpr double kBudget_m = 14.0;
  options.create->planning.travel_budget_m = kBudget_m;
  const EpisodeResult episode = Drive(options);
  EXPECT_TRUE(episode.completed);
  EXPECT_LE(episode.distance_m, kBudget_m);
  EXPECT_GT(episode.distance_m, kBudget_m / 2.0) << "it makes use of it";
  EXPECT_TRUE(HasPhase(episode, MissionPhase::kReturning));
  const Point2 first = episode.path.front().pose.position();
  const Point2 last = episode.path.back().pose.position();
  EXPECT_LE(Distance_m(first, last), 0.4);
}

TEST(WayHomeTest, ARobotReturnsBeforeItsMissionIsComplete) {
  EpisodeOptions options = HallOptions();
  options.duration_s = 300.0;
  options.create->planning.return_home = true;
  // A mission soon over: only the building counts, and no place is worth a visit for its gas alone.
  options.create->planning.strategy = "xit_f";
  options.create->planning.goal_policy = GoalPolicy::kOccupancyOnly;
  options.create->planning.fallback_to_unobserved = false;
  options.create->home = Point2{2.0, 4.0};
  const EpisodeResult episode = Drive(options);
  EXPECT_TRUE(episode.completed);
  EXPECT_LE(Distance_m(episode.path.back().pose.position(), {2.0, 4.0}), 0.4);
  ASSERT_GE(episode.plans.size(), 2u);
  EXPECT_EQ(episode.plans.back().plan.phase, MissionPhase::kComplete);
}

TEST(WayHomeTest, NoRobotDrivesIntoAKeepOutArea) {
  EpisodeOptions options = HallOptions();
  // From the west wall to within 1.2 m of the screen: the robot has to drive round it.
  options.create->keep_out = {{{{0.0, 1.6}, {1.8, 1.6}, {1.8, 2.6}, {0.0, 2.6}}}};
  const EpisodeResult episode = Drive(options);
  double northernmost_m = 0.0;
  for (const DrivenPose& driven : episode.path) {
    const Pose2& at = driven.pose;
    // Paths run through cells whose centre lies outside: half a diagonal of a cell may not.
    constexpr double kInside_m = 0.0708;
    EXPECT_FALSE(at.x_m < 1.8 - kInside_m && at.y_m > 1.6 + kInside_m && at.y_m < 2.6 - kInside_m)
        << at.x_m << ", " << at.y_m;
    northernmost_m = std::max(northernmost_m, at.y_m);
  }
  EXPECT_GT(northernmost_m, 2.6) << "it did get past";
  EXPECT_EQ(episode.collisions, 0);
}

TEST(WayHomeTest, RobotsFollowTrajectoriesWithLimitsOfMotion) {
  for (const auto following : {client::Following::kIdeal, client::Following::kProportional}) {
    EpisodeOptions options = HallOptions();
    options.following = following;
    options.create->planning.max_acceleration_mps2 = 0.5;
    options.create->planning.max_turn_rate_rad_per_s = 1.0;
    const EpisodeResult episode = Drive(options);
    EXPECT_EQ(episode.collisions, 0);
    EXPECT_GT(episode.distance_m, 5.0);
    EXPECT_GE(episode.plans.size(), 2u) << "stops at every bend take time";
    EXPECT_GT(episode.samples.back().metrics.completeness,
              episode.samples.front().metrics.completeness);
  }
}

}  // namespace way_home_test
}  // namespace plumescout::lab
