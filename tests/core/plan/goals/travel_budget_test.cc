// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/travel_budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/types/rng.h"
#include "tests/support/goal_case.h"

namespace plumescout {
namespace travel_budget_test {

using testing::GoalCase;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Home is in the west, 0.7 m from the robot.
const testing::GridArt kCorridor = {"############",  //
                                    "#.......S..#",  //
                                    "############"};

GoalCase InTheCorridor(double budget_m, double travelled_m, double margin = 0.0) {
  GoalCase c(kCorridor);
  c.belief.robots["r"].first_place = c.belief.geometry().Center({1, 1});
  c.belief.robots["r"].travelled_m = travelled_m;
  c.options.travel_budget_m = budget_m;
  c.options.return_margin_share = margin;
  return c;
}

// Straight to the cell.
Candidate To(const GoalCase& c, Cell cell, GoalKind kind = GoalKind::kOccupancyFrontier) {
  const GridGeometry& geometry = c.belief.geometry();
  Candidate candidate;
  candidate.goal = {kind, cell, geometry.Center(cell), geometry.Center(cell), 10};
  candidate.path = {geometry.Center(c.start), candidate.goal.position};
  candidate.length_m = Distance_m(candidate.path[0], candidate.path[1]);
  return candidate;
}

Plan Judge(const GoalCase& c, const std::vector<Candidate>& candidates) {
  Plan plan;
  plan.candidates = candidates;
  RejectOverBudget(c.Query(), plan);
  return plan;
}

TEST(RejectOverBudget, LeavesEnoughToDriveHome) {
  // Two cells there, nine home: 1.1 m.
  for (const double left_m : {1.09, 1.11}) {
    const GoalCase c = InTheCorridor(10.0 + left_m, 10.0);
    const Plan plan = Judge(c, {To(c, {10, 1})});
    EXPECT_EQ(plan.candidates.size(), left_m > 1.1 ? 1u : 0u);
  }
}

TEST(RejectOverBudget, ReckonsFromWhereThePathEnds) {
  const GoalCase c = InTheCorridor(10.0, 0.0);
  Candidate beside = To(c, {10, 1});  // a path as published may end at a sample near its goal
  beside.path.back() = c.belief.geometry().Center({2, 1});
  beside.length_m = Distance_m(beside.path[0], beside.path[1]);
  GoalCase tight = InTheCorridor(0.75, 0.0);  // 0.6 m there, 0.1 m home
  EXPECT_THAT(Judge(tight, {beside}).candidates, SizeIs(1));
}

TEST(RejectOverBudget, KeepsTheMarginOfTheWayHomeBack) {
  const GoalCase without = InTheCorridor(1.15, 0.0);
  const GoalCase with = InTheCorridor(1.15, 0.0, 0.1);
  EXPECT_THAT(Judge(without, {To(without, {10, 1})}).candidates, SizeIs(1));
  EXPECT_THAT(Judge(with, {To(with, {10, 1})}).candidates, IsEmpty());
}

TEST(RejectOverBudget, SaysWhatItReckoned) {
  const GoalCase c = InTheCorridor(12.0, 11.5, 0.1);
  const Plan plan = Judge(c, {To(c, {10, 1})});
  ASSERT_THAT(plan.rejected, SizeIs(1));
  EXPECT_EQ(plan.rejected[0].reason, RejectionReason::kOverBudget);
  EXPECT_EQ(plan.rejected[0].goal.cell, (Cell{10, 1}));
  EXPECT_EQ(plan.rejected[0].detail,
            "0.2 m there and 1.10 x 0.9 m home exceed the 0.5 m left of 12.0 m");
}

TEST(RejectOverBudget, KeepsTheOrderOfTheRest) {
  const GoalCase c = InTheCorridor(1.0, 0.0);
  const Plan plan = Judge(c, {To(c, {3, 1}), To(c, {10, 1}), To(c, {5, 1})});
  ASSERT_THAT(plan.candidates, SizeIs(2));
  EXPECT_EQ(plan.candidates[0].goal.cell.x, 3);
  EXPECT_EQ(plan.candidates[1].goal.cell.x, 5);
}

TEST(RejectOverBudget, LetsTheRobotDriveHomeWhateverIsLeft) {
  const GoalCase c = InTheCorridor(1.0, 50.0);
  const Plan plan = Judge(c, {To(c, {1, 1}, GoalKind::kHome)});
  EXPECT_THAT(plan.candidates, SizeIs(1));
  EXPECT_THAT(plan.rejected, IsEmpty());
}

TEST(RejectOverBudget, RefusesEverythingIfThereIsNoWayHome) {
  GoalCase c = InTheCorridor(1e9, 0.0);
  c.belief.robots["r"].first_place = Point2{-50.0, 0.0};
  EXPECT_THAT(Judge(c, {To(c, {10, 1})}).candidates, IsEmpty());
}

// Home is 0.9 m from the end, 0.2 m are driven: 1.1 s at 1 m/s.
GoalCase WithTime(std::int64_t left_ms, double margin = 0.0) {
  GoalCase c = InTheCorridor(0.0, 0.0, margin);
  c.options.speed_mps = 1.0;
  c.belief.sample_time_ns = 7'000'000'000;
  c.belief.deadline_ns = c.belief.sample_time_ns + left_ms * 1'000'000;
  return c;
}
Candidate Lasting(Candidate candidate, double duration_s) {
  candidate.duration_s = duration_s;
  return candidate;
}

TEST(RejectOverBudget, LeavesEnoughTimeToDriveHome) {
  for (const int left_ms : {1090, 1110}) {
    const GoalCase c = WithTime(left_ms);
    const Plan plan = Judge(c, {Lasting(To(c, {10, 1}), 0.2)});
    ASSERT_EQ(plan.candidates.size(), left_ms == 1110 ? 1u : 0u);
    if (left_ms == 1110) continue;
    EXPECT_EQ(plan.rejected[0].reason, RejectionReason::kOverDeadline);
    EXPECT_EQ(plan.rejected[0].detail, "home 0.0 s after the deadline");
  }
}

TEST(RejectOverBudget, KeepsTheMarginAndTheLatencyBackFromTheTime) {
  GoalCase c = WithTime(1150, 0.1);  // 1.21 s are needed
  EXPECT_THAT(Judge(c, {Lasting(To(c, {10, 1}), 0.2)}).candidates, IsEmpty());
  c.options.return_margin_share = 0.0;
  EXPECT_THAT(Judge(c, {Lasting(To(c, {10, 1}), 0.2)}).candidates, SizeIs(1));
  c.options.planning_latency_s = 0.1;
  EXPECT_THAT(Judge(c, {Lasting(To(c, {10, 1}), 0.2)}).candidates, IsEmpty());
}

TEST(RejectOverBudget, WhoIsSlowOnTheWayThereIsSlowOnTheWayHome) {
  const GoalCase c = WithTime(2000);
  EXPECT_THAT(Judge(c, {Lasting(To(c, {10, 1}), 0.2)}).candidates, SizeIs(1));
  EXPECT_THAT(Judge(c, {Lasting(To(c, {10, 1}), 0.4)}).candidates, IsEmpty());  // 0.5 m/s: 2.2 s
}

TEST(RejectOverBudget, NobodyIsTooLateToGoHome) {
  const GoalCase c = WithTime(-1);
  const Plan plan = Judge(c, {Lasting(To(c, {1, 1}, GoalKind::kHome), 1.0)});
  EXPECT_THAT(plan.candidates, SizeIs(1));
}

TEST(RejectOverBudget, RefusesNothingWithoutABudget) {
  const GoalCase c = InTheCorridor(0.0, 1e6);
  EXPECT_THAT(Judge(c, {To(c, {10, 1}), To(c, {1, 1})}).candidates, SizeIs(2));
}

// Whatever is accepted leaves the shortest way home affordable, by a search of its own: repeated
// relaxation over all cells until nothing gets shorter.
std::vector<double> WaysHomeByRelaxation_m(const Grid<std::uint8_t>& passable, Cell home) {
  const GridGeometry& geometry = passable.geometry();
  std::vector<double> way_m(passable.size(), INFINITY);
  way_m[geometry.Index(home)] = 0.0;
  const auto open = [&](Cell cell) { return passable.At(cell, 0) != 0; };
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (std::size_t i = 0; i < way_m.size(); ++i) {
      const Cell cell = geometry.CellAtIndex(i);
      for (int k = 0; k < 9 && open(cell); ++k) {
        const int dx = k % 3 - 1;
        const int dy = k / 3 - 1;
        const Cell next = {cell.x + dx, cell.y + dy};
        if (!open(next) || !open({cell.x + dx, cell.y}) || !open({cell.x, cell.y + dy})) continue;
        const double via_m =
            way_m[geometry.Index(next)] + std::hypot(dx, dy) * geometry.resolution_m;
        if (via_m < way_m[i] - 1e-12) {
          way_m[i] = via_m;
          shorter = true;
        }
      }
    }
  }
  return way_m;
}

TEST(RejectOverBudget, AcceptsJustThoseFromWhichTheRobotCanGetHome) {
  Rng rng(12);
  for (int trial = 0; trial < 10; ++trial) {
    GoalCase c(kCorridor);
    Grid<std::uint8_t> traversable = testing::RandomObstacles(30, 20, 12, rng);
    const Cell home = {2, 3};
    c.start = {25, 15};
    traversable[home] = traversable[c.start] = 1;
    c.belief.occupancy =
        std::make_shared<const Grid<CellState>>(traversable.geometry(), CellState::kFree);
    c.belief.traversable = std::make_shared<const Grid<std::uint8_t>>(traversable);
    c.reachable = ReachableCells(traversable, {c.start});
    if (c.reachable[home] == 0) continue;
    c.belief.robots["r"].first_place = traversable.geometry().Center(home);
    c.options.travel_budget_m = 5.0;
    const std::vector<double> way_home_m = WaysHomeByRelaxation_m(c.reachable, home);
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < c.reachable.size(); ++i) {
      if (c.reachable[i] != 0) candidates.push_back(To(c, c.reachable.geometry().CellAtIndex(i)));
    }
    const Plan plan = Judge(c, candidates);
    EXPECT_EQ(plan.candidates.size() + plan.rejected.size(), candidates.size());
    for (const Candidate& candidate : plan.candidates) {
      const double back_m = way_home_m[c.reachable.geometry().Index(candidate.goal.cell)];
      EXPECT_LE(candidate.length_m + 1.1 * back_m, 5.0 + 1e-9);
    }
    for (const RejectedGoal& rejected : plan.rejected) {
      const double back_m = way_home_m[c.reachable.geometry().Index(rejected.goal.cell)];
      EXPECT_GT(To(c, rejected.goal.cell).length_m + 1.1 * back_m, 5.0 - 1e-9);
    }
  }
}

}  // namespace travel_budget_test
}  // namespace plumescout
