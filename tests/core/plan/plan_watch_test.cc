// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/plan_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/grid_art.h"
#include "tests/support/strategy_case.h"

namespace plumescout {
namespace plan_watch_test {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kSpeed_mps = 0.5;
constexpr double kCell_m = 1.0;

// Twelve metres of corridor.
const testing::GridArt kCorridor = {"##############",  //
                                    "#............#",  //
                                    "#............#",  //
                                    "#............#",  //
                                    "##############"};

Trajectory Way(Point2 from, Point2 to) {
  Trajectory way;
  way.length_m = Distance_m(from, to);
  way.duration_s = way.length_m / kSpeed_mps;
  const double yaw_rad = std::atan2(to.y_m - from.y_m, to.x_m - from.x_m);
  way.waypoints = {{{from.x_m, from.y_m, yaw_rad}}, {{to.x_m, to.y_m, yaw_rad}, way.duration_s}};
  return way;
}

// Robots in a corridor, and a clock.
class PlanWatchTest : public ::testing::Test {
 protected:
  PlanWatchTest() : belief_(testing::SmallBelief(kCorridor)) {
    belief_.robots.clear();
    belief_.occupancy =
        std::make_shared<const Grid<CellState>>(testing::GridFromArt(kCorridor, kCell_m));
    Grid<std::uint8_t> traversable(belief_.geometry(), 0);
    for (int y = 1; y <= 3; ++y) {
      for (int x = 1; x <= 12; ++x) traversable[Cell{x, y}] = 1;
    }
    belief_.traversable = std::make_shared<const Grid<std::uint8_t>>(traversable);
  }

  Point2 At(int x, int y = 2) const { return belief_.geometry().Center({x, y}); }
  RobotRecord& Stand(const RobotId& robot, Point2 place) {
    RobotRecord& record = belief_.robots[robot];
    record.state.id = robot;
    record.state.radius_m = 0.2;
    record.state.has_pose = true;
    record.state.pose = {place.x_m, place.y_m, 0.0};
    return record;
  }
  void Depart(const RobotId& robot, PlanId plan, Point2 from, Point2 to) {
    RobotRecord& record = Stand(robot, from);
    const Trajectory way = Way(from, to);
    record.last_plan = plan;
    record.live_goal.emplace();
    record.live_arrival_ns = belief_.sample_time_ns + std::llround(way.duration_s * 1e9);
    record.live_trajectory = std::make_shared<const Trajectory>(way);
  }
  // Nobody may drive in the cell of the place.
  void CloseAround(Point2 middle) {
    auto options = std::make_shared<MissionOptions>(*belief_.options);
    constexpr double kHalf_m = 0.4 * kCell_m;
    options->keep_out.push_back({{{middle.x_m - kHalf_m, middle.y_m - kHalf_m},
                                  {middle.x_m + kHalf_m, middle.y_m - kHalf_m},
                                  {middle.x_m + kHalf_m, middle.y_m + kHalf_m},
                                  {middle.x_m - kHalf_m, middle.y_m + kHalf_m}}});
    belief_.options = options;
    Grid<std::uint8_t> traversable = *belief_.traversable;
    traversable[belief_.geometry().CellAt(middle)] = 0;
    belief_.traversable = std::make_shared<const Grid<std::uint8_t>>(traversable);
  }
  void End(const RobotId& robot) {
    belief_.robots[robot].live_trajectory = nullptr;
    belief_.robots[robot].live_goal.reset();
  }
  // Time goes by, half a second at a time, in which robots drive on by plan but for those that
  // stand. What was told.
  std::vector<PlanWatch::News> Run(double duration_s, const std::set<RobotId>& standing = {}) {
    std::vector<PlanWatch::News> told;
    for (double s = 0.0; s < duration_s; s += 0.5) {
      for (auto& one : watch_.Look(belief_)) told.push_back(std::move(one));
      belief_.sample_time_ns += 500'000'000;
      for (auto& [robot, record] : belief_.robots) {
        if (record.live_trajectory == nullptr || standing.count(robot) > 0) continue;
        const Trajectory& way = *record.live_trajectory;
        const double left_s =
            static_cast<double>(record.live_arrival_ns - belief_.sample_time_ns) * 1e-9;
        record.state.pose = PoseAt(way, way.duration_s - std::max(0.0, left_s));
      }
    }
    return told;
  }

  Belief belief_;
  PlanWatch watch_;
};

const PlanInvalidated& Invalidated(const PlanWatch::News& news) {
  return std::get<PlanInvalidated>(news.notice);
}

TEST_F(PlanWatchTest, WhoDrivesByPlanIsToldNothing) {
  Depart("a", 1, At(6), At(12));
  Depart("b", 2, At(1), At(8));
  EXPECT_THAT(Run(40.0), IsEmpty());
}

TEST_F(PlanWatchTest, WhoComesUponAStandingRobotIsToldOnce) {
  Depart("a", 1, At(6), At(12));
  Depart("b", 2, At(1), At(10));
  const auto told = Run(6.0, {"a"});
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].robot, "b");
  const PlanInvalidated& notice = Invalidated(told[0]);
  EXPECT_EQ(notice.plan, 2);
  EXPECT_EQ(notice.reason, InvalidationReason::kMeetsRobot);
  EXPECT_EQ(notice.robot, "a");
  EXPECT_GT(notice.meets_in_s, 0.0);
  EXPECT_LE(notice.meets_in_s, PlanWatchOptions().horizon_s);
  ASSERT_TRUE(notice.place.has_value());
  EXPECT_LT(notice.place->x_m, At(6).x_m);
  EXPECT_FALSE(notice.detail.empty());
}

TEST_F(PlanWatchTest, WhoWasGivenItsWayFirstKeepsIt) {
  Depart("a", 1, At(1), At(10));
  Depart("b", 2, At(6, 1), At(6, 3));  // is late by a little to be past
  const auto told = Run(1.0, {"b"});
  EXPECT_THAT(told, IsEmpty());
  belief_.robots["b"].live_arrival_ns += 4'000'000'000;  // drives on, four seconds late
  for (const auto& one : Run(8.0)) EXPECT_EQ(one.robot, "b");
}

TEST_F(PlanWatchTest, WhoStallsIsInTheWayOfThoseWithEarlierPlansToo) {
  Depart("a", 2, At(6), At(12));
  Depart("b", 1, At(1), At(10));
  const auto told = Run(6.0, {"a"});
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].robot, "b");
}

// It waits by plan for "b" to pass, and then goes its way.
TEST_F(PlanWatchTest, WhoWaitsByPlanIsNotInTheWay) {
  Depart("b", 1, At(1, 1), At(12, 1));
  Depart("a", 2, At(6, 3), At(6, 1));
  Trajectory way = *belief_.robots["a"].live_trajectory;
  way.waypoints[0].dwell_s = 14.0;
  way.waypoints[1].arrival_time_s += 14.0;
  way.duration_s += 14.0;
  belief_.robots["a"].live_arrival_ns += 14'000'000'000;
  belief_.robots["a"].live_trajectory = std::make_shared<const Trajectory>(way);
  EXPECT_THAT(Run(30.0), IsEmpty());
}

TEST_F(PlanWatchTest, ARobotWithoutAPlanIsInTheWayOfAll) {
  Stand("a", At(6)).last_plan = 9;
  Depart("b", 2, At(1), At(10));
  ASSERT_THAT(Run(4.0), SizeIs(1));
}

TEST_F(PlanWatchTest, ARobotThatMovesOnSoonIsNone) {
  Depart("a", 1, At(4), At(5));
  Depart("b", 2, At(1), At(10));
  EXPECT_THAT(Run(0.5), IsEmpty());
  Depart("a", 3, belief_.robots["a"].state.pose.position(), At(4, 1));
  belief_.robots["a"].last_plan = 1;
  EXPECT_THAT(Run(1.0), IsEmpty());
}

TEST_F(PlanWatchTest, FarMeetingsAreLeftToLaterLooks) {
  Stand("a", At(9));  // 16 s away, and 14 in the end
  Depart("b", 1, At(1), At(12));
  EXPECT_THAT(Run(2.0), IsEmpty());
}

TEST_F(PlanWatchTest, RobotsThatHaveBeenSilentForLongAreNotThere) {
  RobotRecord& silent = Stand("a", At(6));
  silent.state.silent = true;
  silent.heard_ns = belief_.sample_time_ns;
  Depart("b", 1, At(1), At(10));
  EXPECT_THAT(Run(4.0), SizeIs(1));
  silent.heard_ns = belief_.sample_time_ns - 200'000'000'000;
  Depart("b", 2, At(1), At(10));
  EXPECT_THAT(Run(4.0), IsEmpty());
}

TEST_F(PlanWatchTest, NobodyYieldsWhereThatIsOff) {
  auto options = std::make_shared<MissionOptions>(*belief_.options);
  options->planning.yield_to_robots = false;
  belief_.options = options;
  Stand("a", At(6));
  Depart("b", 1, At(1), At(10));
  EXPECT_THAT(Run(4.0), IsEmpty());
}

TEST_F(PlanWatchTest, AnotherPlanMayBeToldOfTheSameRobot) {
  Stand("a", At(6));
  Depart("b", 1, At(1), At(10));
  ASSERT_THAT(Run(3.0), SizeIs(1));
  Depart("b", 2, belief_.robots["b"].state.pose.position(), At(10));
  const auto told = Run(3.0);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(Invalidated(told[0]).plan, 2);
}

TEST_F(PlanWatchTest, SomethingSeenOnTheWayBlocksIt) {
  Depart("b", 1, At(1), At(10));
  EXPECT_THAT(Run(1.0), IsEmpty());
  Grid<CellState> states = *belief_.occupancy;
  Grid<std::uint8_t> traversable = *belief_.traversable;
  states[Cell{9, 2}] = CellState::kOccupied;
  traversable[Cell{9, 2}] = 0;
  belief_.occupancy = std::make_shared<const Grid<CellState>>(states);
  belief_.traversable = std::make_shared<const Grid<std::uint8_t>>(traversable);
  const auto told = Run(3.0);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(Invalidated(told[0]).reason, InvalidationReason::kWayBlocked);
  EXPECT_EQ(Invalidated(told[0]).place, belief_.geometry().Center({9, 2}));
}

// Walls grow by what poses err: a way close to one stands.
TEST_F(PlanWatchTest, ACellThatIsOnlyNearAWallBlocksNothing) {
  Depart("b", 1, At(1), At(10));
  Grid<std::uint8_t> traversable = *belief_.traversable;
  traversable[Cell{9, 2}] = 0;
  belief_.traversable = std::make_shared<const Grid<std::uint8_t>>(traversable);
  EXPECT_THAT(Run(3.0), IsEmpty());
}

TEST_F(PlanWatchTest, AWayThroughAnAreaThatWasJustClosedIsToldOfAtOnce) {
  Depart("b", 1, At(1), At(12));
  EXPECT_THAT(Run(1.0), IsEmpty());
  CloseAround(At(9));
  const auto told = watch_.Look(belief_);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(Invalidated(told[0]).reason, InvalidationReason::kKeptOut);
  EXPECT_EQ(Invalidated(told[0]).place, belief_.geometry().Center({9, 2}));
  EXPECT_THAT(Run(1.0), IsEmpty()) << "once";
}

TEST_F(PlanWatchTest, AWayOutOfAnAreaStandsButNotOneThatEndsThere) {
  Depart("a", 1, At(2), At(8));
  Depart("b", 2, At(10), At(12));
  EXPECT_THAT(Run(0.5), IsEmpty());
  CloseAround(At(2));   // where a is
  CloseAround(At(12));  // where b goes
  const auto told = watch_.Look(belief_);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].robot, "b");
}

TEST_F(PlanWatchTest, AWayThroughAClosedAreaIsToldOf) {
  CloseAround(At(9));
  Depart("b", 1, At(1), At(12));
  const auto told = Run(3.0);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(Invalidated(told[0]).reason, InvalidationReason::kKeptOut);
}

TEST_F(PlanWatchTest, APlanThatLapsedIsToldOf) {
  Depart("b", 4, At(1), At(10));
  EXPECT_THAT(Run(1.0), IsEmpty());
  End("b");
  belief_.robots["b"].state.silent = true;
  const auto told = Run(2.0);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(Invalidated(told[0]).plan, 4);
  EXPECT_EQ(Invalidated(told[0]).reason, InvalidationReason::kLapsed);
}

TEST_F(PlanWatchTest, AReportedPlanEndsQuietly) {
  Depart("b", 4, At(1), At(10));
  EXPECT_THAT(Run(1.0), IsEmpty());
  End("b");
  EXPECT_THAT(Run(2.0), IsEmpty());
}

TEST_F(PlanWatchTest, APlanThatWasGivenIsToldOfAndTakesThePlaceOfTheOther) {
  Depart("b", 4, At(1), At(10));
  EXPECT_THAT(Run(1.0), IsEmpty());
  Depart("b", 5, belief_.robots["b"].state.pose.position(), At(8));
  belief_.robots["b"].assigned_plan = 5;
  const auto told = Run(2.0);
  ASSERT_THAT(told, SizeIs(2));
  EXPECT_EQ(Invalidated(told[0]).plan, 4);
  EXPECT_EQ(Invalidated(told[0]).reason, InvalidationReason::kSuperseded);
  EXPECT_EQ(std::get<PlanAssigned>(told[1].notice).plan, 5);
}

TEST_F(PlanWatchTest, ARobotThatLeftIsForgotten) {
  Depart("b", 4, At(1), At(10));
  EXPECT_THAT(Run(1.0), IsEmpty());
  belief_.robots.clear();
  EXPECT_THAT(Run(1.0), IsEmpty());
}

}  // namespace plan_watch_test
}  // namespace plumescout
