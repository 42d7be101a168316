// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/choice.h"

#include <gtest/gtest.h>

#include <memory>

#include "core/gas/gas_map.h"
#include "core/plan/selection/expected_information.h"
#include "core/plan/selection/selection.h"
#include "core/types/rng.h"

namespace plumescout {
namespace choice_test {

// An empty room whose west has been read all over.
Belief HalfReadRoom() {
  const Grid<CellState> states(GridGeometry{0.0, 0.0, 0.1, 60, 20}, CellState::kFree);
  GasMap gas{GasOptions()};
  for (int x = 1; x < 30; x += 2) {
    for (int y = 1; y < 20; y += 2) gas.Add(0, states.geometry().Center({x, y}), {1.0, {}});
  }
  EXPECT_TRUE(gas.Refresh(states, 0).ok());
  Belief belief;
  belief.options = std::make_shared<const MissionOptions>();
  belief.occupancy = std::make_shared<const Grid<CellState>>(states);
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(gas.mean_ppm());
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(gas.variance_ppm2());
  belief.gas_what_if = gas.what_if();
  return belief;
}

Candidate Way(Point2 to, double cost) {
  Candidate candidate;
  candidate.path = {{3.0, 1.0}, to};
  candidate.goal.position = to;
  candidate.cost = cost;
  candidate.duration_s = 2.0;
  return candidate;
}

Plan WestOrEast() {
  Plan plan;
  plan.robot = "r";
  plan.candidates = {Way({0.5, 1.0}, 1.0), Way({5.5, 1.0}, 1.5)};
  return plan;
}

PlanningOptions By(SelectionRule rule, double margin = 0.0) {
  PlanningOptions options;
  options.selection_rule = rule;
  options.commitment_margin_share = margin;
  return options;
}

TEST(Choose, TakesTheWayThatTellsMostIfAsked) {
  const Belief belief = HalfReadRoom();
  Plan plan = WestOrEast();
  Choose(belief, By(SelectionRule::kLeastCost), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, 0);
  EXPECT_FALSE(plan.candidates[0].expected_information_nats.has_value()) << "nobody asked";
  Choose(belief, By(SelectionRule::kInformationRate), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, 1) << "the east is unread";
  // The west is not even priced.
  EXPECT_GT(*plan.candidates[1].expected_information_nats,
            2.0 * *plan.candidates[0].information_bound_nats);
}

// Rooms of 8 m with walls and readings at random, and ways through them.
struct RandomChoice {
  explicit RandomChoice(std::uint64_t seed) : rng(seed) {
    Grid<CellState> states(GridGeometry{0.0, 0.0, 0.1, 80, 80}, CellState::kFree);
    for (int wall = 0; wall < 12; ++wall) {
      const bool along_x = rng.Below(2) == 0;
      Cell cell{static_cast<int>(rng.Below(80)), static_cast<int>(rng.Below(80))};
      for (int i = 0; i < 25 && states.Contains(cell); ++i) {
        states[cell] = CellState::kOccupied;
        ++(along_x ? cell.x : cell.y);
      }
    }
    GasMap gas{GasOptions()};
    for (int i = 0; i < 30; ++i) gas.Add(0, Place(), {rng.Uniform(0.0, 20.0), {}});
    EXPECT_TRUE(gas.Refresh(states, 0).ok());
    belief.options = std::make_shared<const MissionOptions>();
    belief.occupancy = std::make_shared<const Grid<CellState>>(states);
    belief.gas_mean_ppm = std::make_shared<const Grid<float>>(gas.mean_ppm());
    belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(gas.variance_ppm2());
    belief.gas_what_if = gas.what_if();
    const Point2 start = Place();
    for (int i = 0; i < 15; ++i) {
      Candidate& way = plan.candidates.emplace_back();
      way.path = {start, Place(), Place()};
      way.goal.position = way.path.back();
      way.goal.kind = rng.Below(2) == 0 ? GoalKind::kOccupancyFrontier : GoalKind::kInformation;
      way.duration_s = Distance_m(way.path[0], way.path[1]) + Distance_m(way.path[1], way.path[2]);
    }
    plan.robot = "r";
  }
  Point2 Place() { return {rng.Uniform(0.0, 8.0), rng.Uniform(0.0, 8.0)}; }

  Rng rng;
  Belief belief;
  Plan plan;
};

TEST(Choose, PricesNoMoreThanItNeedsAndChoosesAsIfAllWerePriced) {
  std::size_t spared = 0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    RandomChoice random(seed);
    const bool commits = seed % 2 == 0;
    const PlanningOptions options = By(SelectionRule::kInformationRate, commits ? 0.2 : 0.0);
    random.belief.claims = {{"r", 1, random.plan.candidates[3].goal, 1}};
    Plan lazy = random.plan;
    Choose(random.belief, options, NeverStop(), lazy);

    Plan all = random.plan;
    ExpectedInformation information(random.belief);
    for (Candidate& candidate : all.candidates) {
      candidate.expected_information_nats =
          information.Of(ReadingCells(candidate.path, random.belief.geometry(), options));
    }
    const int best = SelectCandidate(all.candidates, options);
    const bool keeps =
        commits && best != 3 &&
        !BeatsByMargin(all.candidates[static_cast<std::size_t>(best)], all.candidates[3], options);
    EXPECT_EQ(lazy.chosen, keeps ? 3 : best) << "seed " << seed;
    EXPECT_EQ(lazy.goal_kept, keeps);
    for (std::size_t i = 0; i < all.candidates.size(); ++i) {
      const Candidate& candidate = lazy.candidates[i];
      const double nats = *all.candidates[i].expected_information_nats;
      if (candidate.expected_information_nats) {
        EXPECT_EQ(*candidate.expected_information_nats, nats);
        EXPECT_FALSE(candidate.information_bound_nats.has_value());
        continue;
      }
      ASSERT_TRUE(candidate.information_bound_nats.has_value());
      EXPECT_GE(*candidate.information_bound_nats, nats);
      ++spared;
    }
    EXPECT_TRUE(lazy.candidates[static_cast<std::size_t>(lazy.chosen)].expected_information_nats);
  }
  EXPECT_GT(spared, 25U * 15U / 2U);
}

TEST(Choose, FallsBackToTheCostIfThereIsNoTimeToPrice) {
  Plan plan = WestOrEast();
  Choose(
      HalfReadRoom(), By(SelectionRule::kInformationRate), [] { return true; }, plan);
  EXPECT_EQ(plan.chosen, 0);
}

TEST(Choose, KeepsTheGoalUnderWayUnlessAnotherIsBetterByTheMargin) {
  Belief belief = HalfReadRoom();
  belief.claims = {{"r", 1, WestOrEast().candidates[1].goal, belief.sample_time_ns + 1}};
  Plan plan = WestOrEast();
  Choose(belief, By(SelectionRule::kLeastCost, 0.5), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, 1);
  EXPECT_TRUE(plan.goal_kept);
  plan = WestOrEast();
  Choose(belief, By(SelectionRule::kLeastCost, 0.2), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, 0);
  EXPECT_FALSE(plan.goal_kept);
}

TEST(Choose, KeepsTheVeryGoalUnderWayAndNotItsNeighbour) {
  Belief belief = HalfReadRoom();
  Plan plan = WestOrEast();
  plan.candidates.push_back(Way({5.5, 1.3}, 1.4));  // within the claim's radius of the east
  belief.claims = {{"r", 1, plan.candidates[2].goal, belief.sample_time_ns + 1}};
  Choose(belief, By(SelectionRule::kLeastCost, 1.0), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, 2);
}

TEST(Choose, DoesNotKeepWhatAnotherRobotDrivesToOrWhatHasExpired) {
  Belief belief = HalfReadRoom();
  const Goal east = WestOrEast().candidates[1].goal;
  belief.claims = {{"other", 1, east, belief.sample_time_ns + 1},
                   {"r", 2, east, belief.sample_time_ns}};
  Plan plan = WestOrEast();
  Choose(belief, By(SelectionRule::kLeastCost, 1.0), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, 0);
}

TEST(Choose, OfNothingIsNothing) {
  Plan plan;
  Choose(HalfReadRoom(), By(SelectionRule::kInformationRate, 0.5), NeverStop(), plan);
  EXPECT_EQ(plan.chosen, -1);
}

}  // namespace choice_test
}  // namespace plumescout
