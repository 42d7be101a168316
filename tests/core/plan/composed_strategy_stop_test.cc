// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What a plan is that was told to stop, and how soon it ends.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "core/plan/composed_strategy.h"
#include "lab/worlds/random_world.h"
#include "tests/support/counting_stop.h"
#include "tests/support/strategy_case.h"

namespace plumescout {
namespace composed_strategy_stop_test {

using testing::CountingStop;
using testing::For;
using testing::kRoom;
using testing::SmallBelief;
using testing::TryPlan;

TEST(Strategy, StoppedBeforeAnyPathIsAnError) {
  const absl::StatusOr<Plan> plan = TryPlan(SmallBelief(kRoom), For("r"), {}, [] { return true; });
  EXPECT_EQ(plan.status().code(), absl::StatusCode::kDeadlineExceeded);
}

TEST(Strategy, StoppedHalfWayReturnsWhatItHas) {
  const lab::RandomWorld world = lab::MakeRandomWorld(2, 3);
  CountingStop never;
  ASSERT_TRUE(TryPlan(world.belief, For(world.robot), {}, never.Fn()).ok());
  bool saw_part = false;
  constexpr int kStops = 200;
  for (int patience = 0; patience < never.asked(); patience += 1 + never.asked() / kStops) {
    CountingStop stop(patience);
    const absl::StatusOr<Plan> plan = TryPlan(world.belief, For(world.robot), {}, stop.Fn());
    if (!plan.ok()) {
      EXPECT_EQ(plan.status().code(), absl::StatusCode::kDeadlineExceeded);
      continue;
    }
    if (plan->end != PlanEnd::kStopped) continue;
    EXPECT_GE(plan->chosen, 0);
    for (const RejectedGoal& goal : plan->rejected) {
      saw_part = saw_part || goal.reason == RejectionReason::kSearchStopped;
    }
  }
  EXPECT_TRUE(saw_part);
}

// A hall that is free and measured but for its west, which nobody saw.
Belief HallOf(int cells) {
  const GridGeometry geometry{0.0, 0.0, 0.1, cells, cells};
  Belief belief = SmallBelief(kRoom);
  auto occupancy = std::make_shared<Grid<CellState>>(geometry, CellState::kFree);
  auto traversable = std::make_shared<Grid<std::uint8_t>>(geometry, std::uint8_t{1});
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells / 4; ++x) {
      (*occupancy)[Cell{x, y}] = CellState::kUnknown;
      (*traversable)[Cell{x, y}] = 0;
    }
  }
  belief.occupancy = occupancy;
  belief.traversable = traversable;
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(geometry, 1.0F);
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(geometry, 100.0F);
  belief.gas_counters.readings = 1;
  belief.robots.at("r").state.pose = {0.05 * cells, 0.05 * cells, 0.0};
  return belief;
}

// How often a plan asks, beside one of a hall with a quarter of the cells.
TEST(Strategy, AsksItsStopInEveryPassOverTheMap) {
  constexpr int kCells = 512;
  constexpr int kLeastPasses = 12;
  std::vector<int> asked;
  for (const int cells : {kCells / 2, kCells}) {
    CountingStop stop;
    const auto plan = TryPlan(HallOf(cells), For("r", 1), PlanningOptions(), stop.Fn());
    ASSERT_TRUE(plan.ok()) << plan.status();
    ASSERT_FALSE(plan->candidates.empty());
    asked.push_back(stop.asked());
  }
  constexpr int kMore = kCells * kCells * 3 / 4 / static_cast<int>(kCellsPerStop);
  EXPECT_GE(asked[1] - asked[0], kLeastPasses * kMore);
}

TEST(Strategy, EndsSoonWheneverItIsToldTo) {
  const Belief belief = HallOf(256);
  CountingStop never;
  ASSERT_TRUE(TryPlan(belief, For("r", 1), PlanningOptions(), never.Fn()).ok());
  for (int patience = 0; patience < never.asked(); patience += 1 + patience / 8) {
    CountingStop stop(patience);
    const auto plan = TryPlan(belief, For("r", 1), PlanningOptions(), stop.Fn());
    EXPECT_TRUE(plan.ok() || plan.status().code() == absl::StatusCode::kDeadlineExceeded);
    EXPECT_LE(stop.asked(), patience + 100) << "of " << never.asked();
  }
}

}  // namespace composed_strategy_stop_test
}  // namespace plumescout
