// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Whatever the belief and the options, a plan comes out: sound, or with a reason.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "core/gas/gas_map.h"
#include "core/occupancy/free_space.h"
#include "core/plan/strategy.h"
#include "core/types/rng.h"
#include "tests/support/plan_map.h"

namespace plumescout {
namespace strategy_random_test {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <typename T>
T OneOf(Rng& rng, std::initializer_list<T> choices) {
  return choices.begin()[rng.Below(choices.size())];
}

// From no free cell over a single one to halls full of clutter; sizes from one cell on.
Grid<CellState> RandomOccupancy(Rng& rng) {
  const int width = 1 + static_cast<int>(rng.Below(40));
  const int height = 1 + static_cast<int>(rng.Below(40));
  Grid<CellState> states(GridGeometry{rng.Uniform(-9.0, 9.0), -3.0, 0.1, width, height});
  const double free_share = OneOf(rng, {0.0, 0.5, 0.9, 1.0});
  const double unknown_share = OneOf(rng, {0.0, 0.3, 1.0});
  for (CellState& state : states.values()) {
    state = rng.Uniform(0.0, 1.0) < free_share      ? CellState::kFree
            : rng.Uniform(0.0, 1.0) < unknown_share ? CellState::kUnknown
                                                    : CellState::kOccupied;
  }
  if (rng.Below(4) == 0) states[rng.Below(states.size())] = CellState::kFree;
  return states;
}

// Computed, flat, not yet known, or of absurd numbers.
void AddGas(Rng& rng, Belief& belief) {
  const Grid<CellState>& states = *belief.occupancy;
  GasMap gas(belief.options->gas);
  for (int k = 0; k < static_cast<int>(rng.Below(20)); ++k) {
    const Cell cell = states.geometry().CellAtIndex(rng.Below(states.size()));
    gas.Add(0, states.geometry().Center(cell), {rng.Uniform(0.0, 100.0), {}});
  }
  const bool computed = rng.Below(4) != 0 && gas.Refresh(states, 0).ok();
  const float filler = OneOf(rng, {kNaN, 0.0F, 1.0F, 1e30F});
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(
      computed ? gas.mean_ppm() : Grid<float>(states.geometry(), filler));
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(
      computed ? gas.variance_ppm2() : Grid<float>(states.geometry(), filler));
  if (computed && belief.gas_mean_ppm->geometry() != states.geometry()) {
    belief.gas_mean_ppm = std::make_shared<const Grid<float>>(states.geometry(), kNaN);
    belief.gas_variance_ppm2 = belief.gas_mean_ppm;
  }
  if (computed) belief.gas_what_if = gas.what_if();
  belief.gas_counters = gas.counters();
}

Belief RandomBelief(Rng& rng) {
  Belief belief;
  belief.revision = 1;
  MissionOptions mission;
  mission.frontier.min_occupancy_cell_count = 1 + static_cast<int>(rng.Below(4));
  mission.frontier.min_gas_cell_count = 1;
  mission.occupancy.inflation_radius_m = OneOf(rng, {0.0, 0.1, 0.2});
  belief.options = std::make_shared<const MissionOptions>(mission);
  belief.occupancy = std::make_shared<const Grid<CellState>>(RandomOccupancy(rng));
  belief.traversable = std::make_shared<const Grid<std::uint8_t>>(
      TraversableCells(*belief.occupancy, mission.occupancy.inflation_radius_m));
  AddGas(rng, belief);
  const GridGeometry& g = belief.geometry();
  RobotRecord& record = belief.robots["r"];
  record.state.id = "r";
  record.state.has_pose = rng.Below(10) != 0;
  record.state.pose = {g.origin_x_m + rng.Uniform(0.0, g.width * g.resolution_m),
                       g.origin_y_m + rng.Uniform(0.0, g.height * g.resolution_m),
                       rng.Uniform(-3.0, 3.0)};
  return belief;
}

PlanningOptions RandomOptions(Rng& rng) {
  PlanningOptions options;
  options.paths = OneOf(rng, {PathKind::kXit, PathKind::kAnytimeXit, PathKind::kGridExact});
  options.goal_policy = OneOf(rng, {GoalPolicy::kGasFirst, GoalPolicy::kOccupancyFirst,
                                    GoalPolicy::kOccupancyOnly, GoalPolicy::kEverything});
  options.cost = OneOf(rng, {CostKind::kUcb, CostKind::kEuclidean, CostKind::kVertices});
  options.selection_cost = OneOf(rng, {CostKind::kUcb, CostKind::kEuclidean, CostKind::kVertices});
  options.selection_rule = OneOf(
      rng, {SelectionRule::kLeastCost, SelectionRule::kMeanUcb, SelectionRule::kInformationRate});
  options.sampling = OneOf(rng, {SamplingKind::kSystematic, SamplingKind::kIid});
  options.sample_count = OneOf(rng, {1, 2, 50, 3000});
  options.alpha_per_m = OneOf(rng, {0.0, 1.0, 1e9});
  options.beta = OneOf(rng, {0.0, 1.0, 1e9});
  options.uniform_share = OneOf(rng, {0.0, 0.2, 1.0});
  options.min_goal_distance_m = OneOf(rng, {0.0, 0.3});
  options.draw_goals = rng.Below(2) == 0;
  options.goal_vertices = rng.Below(2) == 0;
  options.informed_heuristic = rng.Below(2) == 0;
  options.straighten = rng.Below(2) == 0;
  options.grid_guard = rng.Below(2) == 0;
  options.mixture_radius = rng.Below(2) == 0;
  options.commitment_margin_share = OneOf(rng, {0.0, 0.5});
  options.dwell_s = OneOf(rng, {0.0, 5.0});
  options.max_turn_rate_rad_per_s = OneOf(rng, {0.0, 1.0});
  options.max_acceleration_mps2 = OneOf(rng, {0.0, 0.5});
  options.travel_budget_m = OneOf(rng, {0.0, 1.0, 50.0});
  options.return_home = rng.Below(2) == 0;
  options.raw_variance = rng.Below(2) == 0;
  options.nearest_sample_count = OneOf(rng, {1, 3, 100});
  return options;
}

PlanRequest RandomRequest(Rng& rng) {
  PlanRequest request;
  request.robot = "r";
  request.seed = rng.Below(3);
  request.max_edge_evaluations = OneOf(rng, {std::int64_t{0}, std::int64_t{1}, std::int64_t{200}});
  request.go_home = rng.Below(8) == 0;
  if (rng.Below(5) == 0) request.start = Pose2{1e6, -1e6, 0.0};  // off the map
  return request;
}

void ExpectSound(const Plan& plan, const Belief& belief) {
  EXPECT_FALSE(plan.explanation.empty());
  EXPECT_LT(plan.chosen, static_cast<int>(plan.candidates.size()));
  EXPECT_EQ(plan.chosen >= 0, !plan.candidates.empty());
  EXPECT_EQ(plan.chosen >= 0, !plan.trajectory.waypoints.empty());
  Grid<float> penalty(belief.geometry(), kInfinity);
  for (std::size_t i = 0; i < penalty.size(); ++i) {
    if ((*belief.traversable)[i] != 0) penalty[i] = 1.0F;
  }
  for (const Candidate& candidate : plan.candidates) {
    EXPECT_TRUE(std::isfinite(candidate.cost) && candidate.cost >= 0.0);
    EXPECT_TRUE(std::isfinite(candidate.mean_ucb) && std::isfinite(candidate.duration_s));
    EXPECT_TRUE(plan.start_escaped || testing::StaysClear(penalty, candidate.path));
  }
}

TEST(StrategyOnRandomBeliefs, AnswersSoundlyOrSaysWhyNot) {
  constexpr int kBeliefs = 1500;
  int driven = 0;
  int refused = 0;
  for (int seed = 1; seed <= kBeliefs; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(static_cast<std::uint64_t>(seed));
    const Belief belief = RandomBelief(rng);
    const auto strategy = MakeStrategy(RandomOptions(rng));
    ASSERT_TRUE(strategy.ok()) << strategy.status();
    const int polls_to_stop = OneOf(rng, {0, 1, 60, 500, 1'000'000'000});
    int polls = 0;
    const auto plan =
        (*strategy)->Plan(belief, RandomRequest(rng), [&] { return ++polls > polls_to_stop; });
    if (plan.ok()) {
      ExpectSound(*plan, belief);
      driven += plan->chosen >= 0 ? 1 : 0;
      continue;
    }
    ++refused;
    const absl::StatusCode code = plan.status().code();
    EXPECT_TRUE(code == absl::StatusCode::kInvalidArgument ||     // off the map
                code == absl::StatusCode::kFailedPrecondition ||  // no pose
                code == absl::StatusCode::kDeadlineExceeded)      // stopped before the first path
        << plan.status();
  }
  EXPECT_GT(driven, kBeliefs / 10);
  EXPECT_GT(refused, kBeliefs / 10);
}

}  // namespace strategy_random_test
}  // namespace plumescout
