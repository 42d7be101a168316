// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/trajectory_timing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/types/rng.h"

namespace plumescout {
namespace trajectory_timing_test {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kRounding = 1e-12;

PlanningOptions Motion(double speed_mps, double dwell_s = 0.0, double acceleration_mps2 = 0.0,
                       double turn_rate_rad_per_s = 0.0) {
  PlanningOptions options;
  options.speed_mps = speed_mps;
  options.dwell_s = dwell_s;
  options.max_acceleration_mps2 = acceleration_mps2;
  options.max_turn_rate_rad_per_s = turn_rate_rad_per_s;
  return options;
}

TEST(TimeTrajectory, DrivesAtConstantSpeed) {
  const Trajectory t = TimeTrajectory({{0, 0}, {3, 4}, {3, 6}}, 0.0, Motion(2.0));
  ASSERT_THAT(t.waypoints, SizeIs(3));
  EXPECT_EQ(t.waypoints[0].arrival_time_s, 0.0);
  EXPECT_NEAR(t.waypoints[1].arrival_time_s, 2.5, kRounding);
  EXPECT_NEAR(t.waypoints[2].arrival_time_s, 3.5, kRounding);
  EXPECT_NEAR(t.length_m, 7.0, kRounding);
  EXPECT_NEAR(t.duration_s, 3.5, kRounding);
}

TEST(TimeTrajectory, HeadsAlongTheSegmentThatLeavesAndKeepsTheLastHeading) {
  const Trajectory t = TimeTrajectory({{0, 0}, {0, 1}, {-1, 1}, {-1, 0}}, 3.0, Motion(1.0));
  EXPECT_NEAR(t.waypoints[0].pose.yaw_rad, M_PI / 2, kRounding);
  EXPECT_NEAR(t.waypoints[1].pose.yaw_rad, M_PI, kRounding);
  EXPECT_NEAR(t.waypoints[2].pose.yaw_rad, -M_PI / 2, kRounding);
  EXPECT_NEAR(t.waypoints[3].pose.yaw_rad, -M_PI / 2, kRounding);
}

TEST(TimeTrajectory, StandsAtEveryVertexButTheFirst) {
  const Trajectory t = TimeTrajectory({{0, 0}, {1, 0}, {2, 0}}, 0.0, Motion(1.0, 5.0));
  EXPECT_EQ(t.waypoints[0].dwell_s, 0.0);
  EXPECT_EQ(t.waypoints[1].dwell_s, 5.0);
  EXPECT_EQ(t.waypoints[2].dwell_s, 5.0);
  EXPECT_NEAR(t.waypoints[1].arrival_time_s, 1.0, kRounding);
  EXPECT_NEAR(t.waypoints[2].arrival_time_s, 7.0, kRounding);
  EXPECT_NEAR(t.duration_s, 12.0, kRounding);
}

TEST(TimeTrajectory, LeavesOutRepeatedVertices) {
  const Trajectory t = TimeTrajectory({{0, 0}, {0, 0}, {1, 0}, {1, 0}}, 0.5, Motion(1.0, 1.0));
  EXPECT_THAT(t.waypoints, SizeIs(2));
  EXPECT_NEAR(t.duration_s, 2.0, kRounding);
}

TEST(TimeTrajectory, OfNoLengthKeepsTheRobotsHeading) {
  const Trajectory t = TimeTrajectory({{2, 3}}, 0.5, Motion(1.0, 1.0));
  ASSERT_THAT(t.waypoints, SizeIs(1));
  EXPECT_EQ(t.waypoints[0].pose, (Pose2{2, 3, 0.5}));
  EXPECT_EQ(t.duration_s, 0.0);
}

TEST(TimeTrajectory, StopsAndTurnsOnTheSpotAtBends) {
  const Trajectory t =
      TimeTrajectory({{0, 0}, {2, 0}, {2, 1}}, M_PI / 2, Motion(1.0, 0.0, 0.0, 0.5));
  const double quarter_turn_s = M_PI / 2 / 0.5;
  ASSERT_THAT(t.waypoints, SizeIs(5));
  EXPECT_EQ(t.waypoints[0].pose, (Pose2{0, 0, M_PI / 2}));
  EXPECT_EQ(t.waypoints[1].pose, (Pose2{0, 0, 0}));
  EXPECT_NEAR(t.waypoints[1].arrival_time_s, quarter_turn_s, kRounding);
  EXPECT_EQ(t.waypoints[2].pose, (Pose2{2, 0, 0}));
  EXPECT_NEAR(t.waypoints[2].arrival_time_s, quarter_turn_s + 2.0, kRounding);
  EXPECT_EQ(t.waypoints[3].pose, (Pose2{2, 0, M_PI / 2}));
  EXPECT_NEAR(t.duration_s, 2.0 * quarter_turn_s + 3.0, kRounding);
  EXPECT_NEAR(t.length_m, 3.0, kRounding);
}

TEST(TimeTrajectory, DwellsBeforeItTurnsAndOnlyOnceAPlace) {
  const Trajectory t = TimeTrajectory({{0, 0}, {1, 0}, {1, 1}}, 0.0, Motion(1.0, 5.0, 0.0, 1.0));
  ASSERT_THAT(t.waypoints, SizeIs(4));
  EXPECT_EQ(t.waypoints[1].dwell_s, 5.0);
  EXPECT_EQ(t.waypoints[2].dwell_s, 0.0);
  EXPECT_NEAR(t.waypoints[2].arrival_time_s, 1.0 + 5.0 + M_PI / 2, kRounding);
  EXPECT_NEAR(t.duration_s, 1.0 + 5.0 + M_PI / 2 + 1.0 + 5.0, kRounding);
}

TEST(TimeTrajectory, PassesVerticesOfAStraightLineWithoutStopping) {
  const Trajectory t =
      TimeTrajectory({{0, 0}, {1, 0}, {3, 0}, {4, 0}}, 0.0, Motion(1.0, 0.0, 0.25));
  EXPECT_NEAR(t.duration_s, 8.0, kRounding) << "two metres and four seconds for either ramp";
  ASSERT_THAT(t.waypoints, SizeIs(5)) << "the vertices, and where braking begins";
  EXPECT_NEAR(t.waypoints[1].speed_mps, std::sqrt(0.5), kRounding);
  EXPECT_EQ(t.waypoints[2].pose.position(), (Point2{2, 0}));
  EXPECT_NEAR(t.waypoints[2].speed_mps, 1.0, kRounding);
  EXPECT_EQ(t.waypoints[4].speed_mps, 0.0);
}

TEST(TimeTrajectory, StopsWhereItDwellsOnAStraightLine) {
  const Trajectory t = TimeTrajectory({{0, 0}, {1, 0}, {2, 0}}, 0.0, Motion(1.0, 2.0, 4.0));
  EXPECT_NEAR(t.duration_s, 2.0 * (1.0 + 0.25 + 2.0), kRounding);
}

// The quickest time from rest to rest, by passes over small steps as in speed_profile_test.cc, and
// by turning alone between.
double DurationByIntegration_s(const std::vector<Point2>& path, double yaw_rad,
                               const PlanningOptions& options) {
  double time_s = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double dx_m = path[i].x_m - path[i - 1].x_m;
    const double dy_m = path[i].y_m - path[i - 1].y_m;
    const double heading_rad = std::atan2(dy_m, dx_m);
    const double turn_rad = std::acos(std::cos(heading_rad - yaw_rad));
    if (options.max_turn_rate_rad_per_s > 0.0) time_s += turn_rad / options.max_turn_rate_rad_per_s;
    yaw_rad = heading_rad;
    constexpr int kSteps = 20'000;
    const double step_m = std::hypot(dx_m, dy_m) / kSteps;
    for (int k = 0; k < kSteps; ++k) {
      // In the middle of a step the speed that the nearer end allows.
      const double from_rest_m = (std::min(k, kSteps - 1 - k) + 0.5) * step_m;
      const double allowed_mps = options.max_acceleration_mps2 > 0.0
                                     ? std::sqrt(2.0 * options.max_acceleration_mps2 * from_rest_m)
                                     : options.speed_mps;
      time_s += step_m / std::min(allowed_mps, options.speed_mps);
    }
    time_s += options.dwell_s;
  }
  return time_s;
}

std::vector<Point2> RandomPath(Rng& rng) {
  std::vector<Point2> path;
  for (int i = 0; i < 6; ++i) path.push_back({rng.Uniform(-3.0, 3.0), rng.Uniform(-3.0, 3.0)});
  return path;
}

TEST(TimeTrajectory, LastsAsLongAsAnIntegrationInSmallStepsSays) {
  Rng rng(8);
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<Point2> path = RandomPath(rng);
    const double yaw_rad = rng.Uniform(-3.0, 3.0);
    const PlanningOptions options =
        Motion(rng.Uniform(0.2, 2.0), trial % 2 == 0 ? 1.5 : 0.0, trial % 3 == 0 ? 0.0 : 0.7,
               trial % 4 == 0 ? 0.0 : rng.Uniform(0.3, 2.0));
    const double wanted_s = DurationByIntegration_s(path, yaw_rad, options);
    // The midpoint rule errs most in the first step from rest: by 0.59 of sqrt(2 h / a), the time
    // that the step takes; twice a leg. h <= 8.5 m / 20000.
    const double step_s = std::sqrt(2.0 * 8.5 / 20'000 / 0.7);
    EXPECT_NEAR(TimeTrajectory(path, yaw_rad, options).duration_s, wanted_s, 10.0 * 0.6 * step_s);
  }
}

TEST(TimeTrajectory, KeepsTheLimitsAtEveryInstantAndTheLengthOfThePath) {
  Rng rng(9);
  constexpr double kTick_s = 1e-3;
  for (int trial = 0; trial < 10; ++trial) {
    const std::vector<Point2> path = RandomPath(rng);
    const PlanningOptions options = Motion(1.25, 0.0, 0.5, 1.0);
    const Trajectory t = TimeTrajectory(path, 1.0, options);
    double driven_m = 0.0;
    double speed_mps = 0.0;
    Pose2 before = PoseAt(t, 0.0);
    for (double time_s = kTick_s; time_s < t.duration_s + kTick_s; time_s += kTick_s) {
      const Pose2 pose = PoseAt(t, time_s);
      const double step_m = Distance_m(before.position(), pose.position());
      const double turn_rad = std::abs(WrapAngle_rad(pose.yaw_rad - before.yaw_rad));
      ASSERT_LE(step_m, options.speed_mps * kTick_s * (1.0 + 1e-9));
      ASSERT_LE(turn_rad, options.max_turn_rate_rad_per_s * kTick_s * (1.0 + 1e-6));
      ASSERT_LE(std::abs(step_m / kTick_s - speed_mps),
                options.max_acceleration_mps2 * kTick_s * (1.0 + 1e-6));
      driven_m += step_m;
      speed_mps = step_m / kTick_s;
      before = pose;
    }
    EXPECT_NEAR(driven_m, t.length_m, 1e-6);
  }
}

TEST(TimeTrajectory, LastsLongButNotForEverUnderTheTightestLimits) {
  const Trajectory t =
      TimeTrajectory({{0, 0}, {2000, 0}, {0, 0}}, 3.0, Motion(1e-3, 0.0, 1e-3, 1e-3));
  EXPECT_LT(t.duration_s, 1e8);
  EXPECT_GT(t.duration_s, 4e6);
}

TEST(TimeTrajectory, OfNothingIsEmpty) {
  EXPECT_THAT(TimeTrajectory({}, 0.0, Motion(1.0, 1.0)).waypoints, IsEmpty());
}

TEST(TimeTrajectory, StandsAtTheStopsItIsGivenAlone) {
  const std::vector<Point2> path = {{0, 0}, {1, 0}, {1, 1}, {3, 1}};
  const Trajectory t = TimeTrajectory(path, {{1, 0}, {3, 1}}, 0.0, Motion(1.0, 5.0));
  ASSERT_THAT(t.waypoints, SizeIs(4));
  EXPECT_EQ(t.waypoints[0].dwell_s, 0.0);
  EXPECT_EQ(t.waypoints[1].dwell_s, 5.0);
  EXPECT_EQ(t.waypoints[2].dwell_s, 0.0);
  EXPECT_EQ(t.waypoints[3].dwell_s, 5.0);
  EXPECT_NEAR(t.duration_s, 4.0 + 10.0, kRounding);
}

TEST(TimeTrajectory, AStopAtTheStartIsStoodAtFirst) {
  const Trajectory t = TimeTrajectory({{0, 0}, {2, 0}}, {{0, 0}}, 0.0, Motion(1.0, 5.0));
  EXPECT_EQ(t.waypoints.at(0).dwell_s, 5.0);
  EXPECT_EQ(t.waypoints.at(1).dwell_s, 0.0);
  EXPECT_NEAR(t.waypoints[1].arrival_time_s, 7.0, kRounding);
  const Trajectory here = TimeTrajectory({{0, 0}, {0, 0}}, {{0, 0}}, 0.5, Motion(1.0, 5.0));
  ASSERT_THAT(here.waypoints, SizeIs(1));
  EXPECT_NEAR(here.duration_s, 5.0, kRounding);
}

TEST(TimeTrajectory, PassesAPlaceWhoseTurnAsAStopHasNotCome) {
  // Over (1, 0) on its way to (2, 0), and back to it.
  const Trajectory t =
      TimeTrajectory({{0, 0}, {1, 0}, {2, 0}, {1, 0}}, {{2, 0}, {1, 0}}, 0.0, Motion(1.0, 5.0));
  EXPECT_EQ(t.waypoints.at(1).dwell_s, 0.0);
  EXPECT_EQ(t.waypoints.at(2).dwell_s, 5.0);
  EXPECT_EQ(t.waypoints.at(3).dwell_s, 5.0);
}

TEST(TimeTrajectory, WithALimitOfAccelerationComesToRestAtStopsOnAStraightLine) {
  const std::vector<Point2> path = {{0, 0}, {1, 0}, {2, 0}};
  const PlanningOptions motion = Motion(1.0, 3.0, 1.0);
  // Rest to rest over 1 m at 1 m/s^2: 2 s; over 2 m at up to 1 m/s: 3 s.
  EXPECT_NEAR(TimeTrajectory(path, {{1, 0}, {2, 0}}, 0.0, motion).duration_s, 2 * (2.0 + 3.0),
              kRounding);
  EXPECT_NEAR(TimeTrajectory(path, {{2, 0}}, 0.0, motion).duration_s, 3.0 + 3.0, kRounding);
}

TEST(TimeTrajectory, WithoutStopsOrPathNothingIsStoodAt) {
  EXPECT_NEAR(TimeTrajectory({{0, 0}, {2, 0}}, {}, 0.0, Motion(1.0, 5.0)).duration_s, 2.0,
              kRounding);
  EXPECT_THAT(TimeTrajectory({}, {}, 0.0, Motion(1.0, 5.0)).waypoints, IsEmpty());
}

}  // namespace trajectory_timing_test
}  // namespace plumescout
