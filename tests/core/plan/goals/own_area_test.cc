// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/own_area.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/grid/grid_search.h"
#include "core/types/rng.h"
#include "tests/support/goal_case.h"

namespace plumescout {
namespace own_area_test {

using testing::GoalCase;

constexpr int kWidth = 122;
constexpr int kHeight = 32;

// A hall of 12 m x 3 m, open all over, and the robot "r" in its west.
testing::GridArt HallArt() {
  testing::GridArt art(kHeight, "#" + std::string(kWidth - 2, '.') + "#");
  art.front() = art.back() = std::string(kWidth, '#');
  art[kHeight / 2][5] = 'S';
  return art;
}

// Nothing of its gas is observed.
GoalCase Hall() {
  GoalCase c(HallArt());
  c.AddGas(testing::GridArt(kHeight, std::string(kWidth, '.')), 0.0F);
  return c;
}

RobotRecord& AddRobot(GoalCase& c, const RobotId& id, Cell cell) {
  RobotRecord& record = c.belief.robots[id];
  record.state.id = id;
  record.state.has_pose = true;
  const Point2 place = c.belief.geometry().Center(cell);
  record.state.pose = {place.x_m, place.y_m, 0.0};
  return record;
}

// Calls visit(cell) for those that can be reached.
template <typename Visit>
void ForEachReachable(const GoalCase& c, const Visit& visit) {
  for (std::size_t i = 0; i < c.reachable.size(); ++i) {
    if (c.reachable[i] != 0) visit(c.reachable.geometry().CellAtIndex(i));
  }
}

// The cells without observed gas in each robot's area.
std::map<RobotId, double> Loads(const GoalCase& c, const OwnArea& area) {
  std::map<RobotId, double> loads;
  ForEachReachable(c, [&](Cell cell) {
    if ((*c.belief.gas_variance_ppm2)[cell] > 0.5F) loads[area.OwnerOf(cell)] += 1.0;
  });
  return loads;
}

// By the shortest ways alone.
std::map<RobotId, double> NearestLoads(const GoalCase& c) {
  std::map<RobotId, Grid<double>> ways_m;
  for (const auto& [id, record] : c.belief.robots) {
    const Cell cell = c.belief.geometry().CellAt(record.state.pose.position());
    ways_m[id] = TravelDistances_m(c.reachable, std::vector<Cell>{cell});
  }
  std::map<RobotId, double> loads;
  ForEachReachable(c, [&](Cell cell) {
    const auto nearest = std::min_element(ways_m.begin(), ways_m.end(), [&](auto& a, auto& b) {
      return a.second[cell] < b.second[cell];
    });
    loads[nearest->first] += 1.0;
  });
  return loads;
}

double Most(const std::map<RobotId, double>& loads) {
  double most = 0.0;
  for (const auto& [id, load] : loads) most = std::max(most, load);
  return most;
}

double Mean(const GoalCase& c, const std::map<RobotId, double>& loads) {
  double sum = 0.0;
  for (const auto& [id, load] : loads) sum += load;
  return sum / static_cast<double>(c.belief.robots.size());
}

TEST(OwnArea, IsNobodysWhoHasNoOtherToShareWith) {
  GoalCase c = Hall();
  EXPECT_FALSE(OwnArea::Find(c.Query(), {}));
  RobotRecord& other = AddRobot(c, "a", {60, 10});
  EXPECT_TRUE(OwnArea::Find(c.Query(), {}));
  other.state.silent = true;
  EXPECT_FALSE(OwnArea::Find(c.Query(), {})) << "silent";
  other.state.silent = false;
  other.state.ordered_home = true;
  EXPECT_FALSE(OwnArea::Find(c.Query(), {})) << "sent home";
  other.state.ordered_home = false;
  other.state.has_pose = false;
  EXPECT_FALSE(OwnArea::Find(c.Query(), {})) << "nowhere";
}

TEST(OwnArea, RobotsAtBothEndsMeetInTheMiddle) {
  GoalCase c = Hall();
  AddRobot(c, "a", {kWidth - 6, kHeight / 2});
  const std::optional<OwnArea> area = OwnArea::Find(c.Query(), {});
  ASSERT_TRUE(area);
  EXPECT_TRUE(area->Has(c.start));
  EXPECT_TRUE(area->Has({40, 5}));
  EXPECT_FALSE(area->Has({80, 5}));
  EXPECT_EQ(area->OwnerOf({80, 5}), "a");
}

TEST(OwnArea, WhoStandsNearMoreGetsNoMore) {
  GoalCase c = Hall();
  AddRobot(c, "a", {20, kHeight / 2});
  EXPECT_GT(Most(NearestLoads(c)), 1.7 * Mean(c, NearestLoads(c))) << "by ways alone";
  const std::optional<OwnArea> area = OwnArea::Find(c.Query(), {});
  ASSERT_TRUE(area);
  const std::map<RobotId, double> loads = Loads(c, *area);
  // To the west of both ways differ by no more than to the east: it is one lump.
  EXPECT_LE(Most(loads), 0.95 * Most(NearestLoads(c)));
}

TEST(OwnArea, LoadsOfRobotsThatStandApartAreEven) {
  Rng rng(3);
  for (int k = 0; k < 20; ++k) {
    GoalCase c = Hall();
    AddRobot(c, "a", {static_cast<int>(30 + rng.Below(20)), static_cast<int>(2 + rng.Below(28))});
    AddRobot(c, "s", {static_cast<int>(65 + rng.Below(20)), static_cast<int>(2 + rng.Below(28))});
    AddRobot(c, "z", {static_cast<int>(95 + rng.Below(20)), static_cast<int>(2 + rng.Below(28))});
    const std::optional<OwnArea> area = OwnArea::Find(c.Query(), {});
    ASSERT_TRUE(area);
    const std::map<RobotId, double> loads = Loads(c, *area);
    EXPECT_LE(Most(loads), 1.1 * Mean(c, loads)) << k;
    EXPECT_LE(Most(loads), Most(NearestLoads(c))) << k;
  }
}

TEST(OwnArea, WhatIsObservedIsNoWork) {
  testing::GridArt measured(kHeight, std::string(kWidth / 2, 'g') + std::string(kWidth / 2, '.'));
  GoalCase c = Hall();
  c.AddGas(measured, 0.0F);
  AddRobot(c, "a", {kWidth - 6, kHeight / 2});
  const std::optional<OwnArea> area = OwnArea::Find(c.Query(), {});
  ASSERT_TRUE(area);
  EXPECT_TRUE(area->Has({75, 5})) << "it has done its half, and takes some of the other's";
  const std::map<RobotId, double> loads = Loads(c, *area);
  EXPECT_LE(Most(loads), 1.1 * Mean(c, loads));
}

TEST(OwnArea, EdgesOfTheUnseenAreWork) {
  GoalCase c = Hall();
  c.AddGas(testing::GridArt(kHeight, std::string(kWidth, 'g')), 0.0F);
  AddRobot(c, "a", {kWidth - 6, kHeight / 2});
  FrontierGoals frontiers;
  for (const int x : {80, 100}) {
    Goal goal = testing::GoalAt({x, 10}, c.belief.geometry());
    goal.kind = GoalKind::kOccupancyFrontier;
    goal.frontier_cells = 20;
    frontiers.occupancy.push_back({goal, 1.0});
  }
  const std::optional<OwnArea> area = OwnArea::Find(c.Query(), frontiers);
  ASSERT_TRUE(area);
  EXPECT_TRUE(area->Has({80, 10}));
  EXPECT_FALSE(area->Has({100, 10}));
  // One that the other is on its way to is its work as well.
  frontiers.rejected.push_back(
      {frontiers.occupancy.back().goal, RejectionReason::kClaimed, "by robot \"a\""});
  frontiers.occupancy.pop_back();
  EXPECT_TRUE(OwnArea::Find(c.Query(), frontiers)->Has({80, 10}));
}

TEST(OwnArea, IsTheSameForAllThatShare) {
  GoalCase c = Hall();
  AddRobot(c, "a", {50, 10});
  AddRobot(c, "z", {90, 20});
  const std::optional<OwnArea> mine = OwnArea::Find(c.Query(), {});
  GoalQuery others = c.Query();
  const GoalQuery theirs = {c.belief, c.belief.robots.at("a"), {50, 10}, c.reachable, c.options};
  const std::optional<OwnArea> also = OwnArea::Find(theirs, {});
  ASSERT_TRUE(mine && also);
  ForEachReachable(c, [&](Cell cell) { ASSERT_EQ(mine->OwnerOf(cell), also->OwnerOf(cell)); });
}

}  // namespace own_area_test
}  // namespace plumescout
