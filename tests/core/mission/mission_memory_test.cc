// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Missions that run out of memory, that see far over open ground, or that are abandoned.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/mission/mission.h"
#include "core/plan/strategy.h"
#include "core/types/error_reason.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_memory_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kLeastBudget_bytes = std::int64_t{32} << 20;

// What a robot sends one thing after another, from anywhere.
class Robot {
 public:
  explicit Robot(const MissionOptions& options) : options_(options) {
    options_.max_robot_speed_mps = 0.0;
    mission_ = Mission::Create(options_).value();
    Send(RobotRegistered{"a", 0.2, 1});
  }

  Mission& mission() { return *mission_; }
  const MissionOptions& options() const { return options_; }  // that it was made with
  const std::vector<EventBody>& log() const { return log_; }
  // The refusal of the observation, or OK.
  absl::Status Observe(const Pose2& pose, decltype(Observation::payload) payload) {
    ++sequence_;
    return Send(ObservationReceived{"a", {sequence_, sequence_ * kSecond_ns, pose, payload}})
        .observation;
  }
  absl::Status Refresh() { return Send(PosteriorRefreshed{mission_->sample_time_ns()}).posterior; }

 private:
  Applied Send(EventBody body) {
    const auto applied = mission_->Apply(body);
    EXPECT_TRUE(applied.ok()) << applied.status();
    log_.push_back(std::move(body));
    return applied.value_or(Applied{});
  }

  MissionOptions options_;
  std::unique_ptr<Mission> mission_;
  std::vector<EventBody> log_;
  std::int64_t sequence_ = 0;
};

// Nothing returns.
Scan OpenScan(double range_m) {
  return {-M_PI, 2.0 * M_PI / 360, range_m,
          std::vector<float>(360, std::numeric_limits<float>::infinity())};
}

TEST(MissionMemory, AMapBeyondTheBudgetGrowsNoMore) {
  MissionOptions options;
  options.memory_budget_bytes = kLeastBudget_bytes;
  Robot robot(options);
  ASSERT_TRUE(robot.Observe({2.0, 2.0, 0.0}, support::ScanInBox({2.0, 2.0, 0.0}, 4.0, 4.0)).ok());
  ASSERT_TRUE(robot.Refresh().ok());
  absl::Status refused;
  double x_m = 2.0;
  while (refused.ok() && x_m < 200.0) {
    x_m += 10.0;
    const std::int64_t before_bytes = robot.mission().memory_bytes();
    refused = robot.Observe({x_m, 2.0, 0.0}, OpenScan(5.0));
    if (!refused.ok()) {
      EXPECT_EQ(robot.mission().memory_bytes(), before_bytes);
    }
    EXPECT_LE(robot.mission().memory_bytes(), options.memory_budget_bytes);
  }
  EXPECT_EQ(ErrorReason(refused), reason::kBudgetReached) << refused;
  // On the map that there is, all goes on.
  const Pose2 home{2.5, 2.0, 0.0};
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(robot.Observe(home, support::ScanInBox(home, 4.0, 4.0)).ok());
  }
  EXPECT_TRUE(robot.Observe(home, GasReading{3.0, 0.0}).ok());
  EXPECT_TRUE(robot.Refresh().ok());
  EXPECT_EQ(robot.mission().Snapshot()->gas_counters.in_posterior, 1);
  PlanRequest request;
  request.robot = "a";
  const auto plan =
      (*MakeStrategy(PlanningOptions()))->Plan(*robot.mission().Snapshot(), request, NeverStop());
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_GE(plan->chosen, 0) << plan->explanation;

  const auto replay = Mission::Create(robot.options()).value();
  for (const EventBody& body : robot.log()) ASSERT_TRUE(replay->Apply(body).ok());
  EXPECT_EQ(replay->memory_bytes(), robot.mission().memory_bytes());
  EXPECT_TRUE(support::SameBytes(*replay->Snapshot()->gas_variance_ppm2,
                                 *robot.mission().Snapshot()->gas_variance_ppm2));
}

TEST(MissionMemory, ReadingsBeyondTheBudgetAreRefused) {
  MissionOptions options;
  options.memory_budget_bytes = kLeastBudget_bytes;
  Robot robot(options);
  absl::Status refused;
  int taken = 0;
  for (int k = 0; refused.ok() && k < 200'000; ++k) {
    refused = robot.Observe({0.7 * (k % 1000), 0.7 * (k / 1000), 0.0}, GasReading{1.0, 0.0});
    taken += refused.ok() ? 1 : 0;
  }
  EXPECT_EQ(ErrorReason(refused), reason::kBudgetReached) << refused;
  EXPECT_GT(taken, 1000);
  EXPECT_LE(robot.mission().memory_bytes(), options.memory_budget_bytes);
  EXPECT_EQ(robot.mission().Snapshot()->gas_counters.readings, taken);
}

TEST(MissionMemory, ReadingsThatWaitAtTooManyPlacesAreRefused) {
  Robot robot({});
  absl::Status refused;
  std::size_t taken = 0;
  for (int k = 0; refused.ok() && k < 200'000; ++k) {
    refused = robot.Observe({0.7 * (k % 1000), 0.7 * (k / 1000), 0.0}, GasReading{1.0, 0.0});
    taken += refused.ok() ? 1 : 0;
  }
  EXPECT_EQ(ErrorReason(refused), reason::kBudgetReached) << refused;
  EXPECT_EQ(taken, ReadingStore::kMostWaitingSites);
  EXPECT_TRUE(robot.Observe({0.0, 0.0, 0.0}, GasReading{1.0, 0.0}).ok()) << "a place that waits";
}

TEST(MissionMemory, AFieldTooLargeForTheBudgetBecomesCoarser) {
  MissionOptions options;
  options.memory_budget_bytes = std::int64_t{80} << 20;
  Robot robot(options);
  for (int k = 0; k < 8; ++k) {
    ASSERT_TRUE(robot.Observe({2.0 + 4.0 * k, 2.0, 0.0}, OpenScan(8.0)).ok());
    ASSERT_TRUE(robot.Observe({2.0 + 4.0 * k, 2.0, 0.0}, OpenScan(8.0)).ok());
    ASSERT_TRUE(robot.Observe({2.0 + 4.0 * k, 2.0, 0.0}, OpenScan(8.0)).ok());
    ASSERT_TRUE(robot.Observe({2.0 + 4.0 * k, 2.0, 0.0}, GasReading{5.0, 0.0}).ok());
    ASSERT_TRUE(robot.Refresh().ok());
    EXPECT_LE(robot.mission().memory_bytes(), options.memory_budget_bytes);
  }
  EXPECT_GT(robot.mission().lattice_factor(), 1);
  EXPECT_EQ(robot.mission().options().gas.lattice_factor, 1) << "what it began with";
  const auto belief = robot.mission().Snapshot();
  EXPECT_EQ(belief->gas_counters.in_posterior, 8);
  for (std::size_t i = 0; i < belief->occupancy->size(); ++i) {
    const bool free = (*belief->occupancy)[i] == CellState::kFree;
    ASSERT_EQ(std::isfinite((*belief->gas_variance_ppm2)[i]), free);
  }
}

// A known map that is too large counts as visited where robots are.
TEST(MissionMemory, FarFromRobotsTheFieldHasItsPrior) {
  MissionOptions options;
  options.gas.field_reach_m = 7.0;
  options.gas.background_mean_ppm = 4.0;
  options.prior_map = std::make_shared<const Grid<CellState>>(GridGeometry{0.0, 0.0, 0.1, 640, 320},
                                                              CellState::kFree);
  Robot robot(options);
  ASSERT_TRUE(robot.Refresh().ok());
  const auto prior = static_cast<float>(OpenLatticeVariance_ppm2(options.gas));
  const auto at = [&](Point2 place) {
    const auto belief = robot.mission().Snapshot();
    const Cell cell = belief->geometry().CellAt(place);
    return std::pair((*belief->gas_mean_ppm)[cell], (*belief->gas_variance_ppm2)[cell]);
  };
  EXPECT_EQ(robot.mission().Snapshot()->gas_what_if, nullptr);
  EXPECT_EQ(at({3.0, 3.0}), std::pair(4.0F, prior));
  ASSERT_TRUE(robot.Observe({3.0, 3.0, 0.0}, GasReading{30.0, 0.0}).ok());
  ASSERT_TRUE(robot.Refresh().ok());
  EXPECT_LT(at({3.0, 3.0}).second, prior);
  EXPECT_GT(at({3.0, 3.0}).first, 20.0F);
  EXPECT_EQ(at({60.0, 3.0}), std::pair(4.0F, prior));
  const auto belief = robot.mission().Snapshot();
  ASSERT_NE(belief->gas_what_if, nullptr);
  EXPECT_LT(belief->gas_what_if->geometry().width, belief->geometry().width);
  // The field grows with the robot's way, to the west where indices begin as well.
  ASSERT_TRUE(robot.Observe({60.0, 30.0, 0.0}, GasReading{10.0, 0.0}).ok());
  ASSERT_TRUE(robot.Refresh().ok());
  EXPECT_LT(at({60.0, 30.0}).second, prior);
  EXPECT_GT(at({3.0, 3.0}).first, 20.0F);
  EXPECT_EQ(at({32.0, 3.0}), std::pair(4.0F, prior));
  EXPECT_EQ(robot.mission().Snapshot()->gas_counters.in_posterior, 2);
}

TEST(MissionMemory, WhatLiesWithinReachIsNotAffectedByIt) {
  const auto variance = [](double reach_m) {
    MissionOptions options;
    options.gas.field_reach_m = reach_m;
    Robot robot(options);
    for (const double x_m : {2.0, 9.0, 30.0}) {
      const Pose2 pose{x_m, 2.0, 0.0};
      for (int k = 0; k < 3; ++k) {
        EXPECT_TRUE(robot.Observe(pose, support::ScanInBox(pose, 34.0, 5.0)).ok());
      }
      EXPECT_TRUE(robot.Observe(pose, GasReading{x_m, 0.0}).ok());
      EXPECT_TRUE(robot.Refresh().ok());
    }
    return robot.mission().Snapshot()->gas_variance_ppm2;
  };
  EXPECT_TRUE(support::SameBytes(*variance(0.0), *variance(MissionOptions().gas.field_reach_m)));
}

TEST(MissionMemory, PlansAndInformationArePricedAcrossTheEdgeOfTheField) {
  MissionOptions options;
  options.gas.field_reach_m = 7.0;
  Robot robot(options);
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(robot.Observe({3.0, 3.0, 0.0}, OpenScan(30.0)).ok());
  }
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(robot.Observe({3.0 + 0.1 * k, 3.0, 0.0}, GasReading{9.0, 0.0}).ok());
  }
  ASSERT_TRUE(robot.Refresh().ok());
  for (const char* name : {"plumescout", "xit_gff"}) {
    PlanningOptions planning;
    planning.strategy = name;
    ASSERT_TRUE(ApplyStrategyRow(planning).ok());
    PlanRequest request;
    request.robot = "a";
    const auto plan =
        (*MakeStrategy(planning))->Plan(*robot.mission().Snapshot(), request, NeverStop());
    ASSERT_TRUE(plan.ok()) << plan.status();
    EXPECT_GE(plan->chosen, 0) << name << ": " << plan->explanation;
  }
}

TEST(MissionMemory, AnAbandonedMissionEndsWithCancelled) {
  Robot robot({});
  bool stop = false;
  robot.mission().AbandonWhen([&] { return stop; });
  ASSERT_TRUE(robot.Observe({2.0, 2.0, 0.0}, OpenScan(8.0)).ok());
  ASSERT_TRUE(robot.Refresh().ok());
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(robot.Observe({2.0, 2.0, 0.0}, OpenScan(8.0)).ok());
  stop = true;
  const auto refreshed =
      robot.mission().Apply(PosteriorRefreshed{robot.mission().sample_time_ns()});
  EXPECT_TRUE(absl::IsCancelled(refreshed.status())) << refreshed.status();
}

}  // namespace mission_memory_test
}  // namespace plumescout
