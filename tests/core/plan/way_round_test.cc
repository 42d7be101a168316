// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/way_round.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "core/plan/right_of_way.h"
#include "core/plan/trajectory_timing.h"
#include "core/traffic/traffic.h"
#include "core/types/rng.h"
#include "tests/support/plan_map.h"

namespace plumescout {
namespace way_round_test {

using ::testing::SizeIs;

constexpr std::int64_t kNow_ns = 50'000'000'000;
constexpr double kStraightCost = 10.0;

RobotRecord At(const RobotId& robot, Point2 place) {
  RobotRecord record;
  record.state.id = robot;
  record.state.radius_m = 0.2;
  record.state.has_pose = true;
  record.state.pose = {place.x_m, place.y_m, 0.0};
  return record;
}

// A corridor along x in which robot "a" stands at the west end, with a plan to its east end.
class Corridor {
 public:
  // The robot stands so far beside the centre of its cell.
  explicit Corridor(double width_m, double beside_x_m = 0.0, double beside_y_m = 0.0)
      : geometry_{0.0, 0.0, 0.1, 120, static_cast<int>(std::lround(width_m / 0.1))},
        middle_m_(geometry_.Center({0, geometry_.height / 2}).y_m),
        start_{1.05 + beside_x_m, middle_m_ + beside_y_m},
        reachable_(geometry_, 1),
        mean_ppm_(geometry_, 0.0F) {
    belief_.sample_time_ns = kNow_ns;
    belief_.options = std::make_shared<const MissionOptions>();
    belief_.robots["a"] = At("a", start_);
    information_.value = Grid<float>(geometry_, 0.5F);
    information_.penalty = Grid<float>(geometry_, 0.5F);
    information_.min_penalty = 0.5F;
  }

  double middle_m() const { return middle_m_; }
  void Stands(Point2 place) { belief_.robots["b"] = At("b", place); }
  void Drives(const std::vector<Point2>& way) {
    RobotRecord& robot = belief_.robots["b"] = At("b", way.front());
    const Trajectory trajectory = TimeTrajectory(way, 0.0, {});
    robot.live_trajectory = std::make_shared<const Trajectory>(trajectory);
    robot.live_arrival_ns = kNow_ns + std::llround(trajectory.duration_s * 1e9);
  }

  Candidate Straight() const {
    Candidate candidate;
    candidate.goal = goal_;
    candidate.path = {start_, goal_.position};
    candidate.length_m = Distance_m(candidate.path[0], candidate.path[1]);
    candidate.duration_s = TimeTrajectory(candidate.path, 0.0, {}).duration_s;
    candidate.cost = kStraightCost;
    return candidate;
  }
  // Half a metre away, which nobody blocks.
  Candidate Near(double cost) const {
    Candidate candidate = Straight();
    candidate.goal.position = {start_.x_m - 0.5, start_.y_m};
    candidate.goal.cell = geometry_.CellAt(candidate.goal.position);
    candidate.path = {start_, candidate.goal.position};
    candidate.duration_s = TimeTrajectory(candidate.path, 0.0, {}).duration_s;
    candidate.cost = cost;
    return candidate;
  }
  // With LeadRound, and then YieldToRobots. `beside`: other candidates.
  Plan Planned(const PlanningOptions& options = {},
               const std::vector<Candidate>& beside = {}) const {
    Plan plan;
    plan.robot = "a";
    plan.candidates = {Straight()};
    plan.candidates.insert(plan.candidates.end(), beside.begin(), beside.end());
    const EdgeCost cost(information_, CostKind::kUcb, 0.0);
    const std::vector<Goal> goals = {goal_};
    const StopFn never = NeverStop();
    const Departure departure = {{}, start_, 0.0};
    const GoalQuery query = {belief_, belief_.robots.at("a"), geometry_.CellAt(start_), reachable_,
                             options};
    std::optional<Waits> waits = FindWaits(belief_, 0.0, options, plan);
    if (!waits) return plan;
    LeadRound({query,
               departure,
               {cost, reachable_, departure.start, goals, 1, 0, never},
               {cost, mean_ppm_, 0.0}},
              *waits, plan);
    const Trajectory way = TimeTrajectory(plan.candidates[0].path, 0.0, options);
    EXPECT_EQ(waits->waits_s[0], waits->traffic.LeastWait_s(way)) << "of the way that was kept";
    YieldToRobots(*waits, 0.0, options, plan);
    return plan;
  }

 private:
  GridGeometry geometry_;
  double middle_m_;
  Point2 start_;
  Belief belief_;
  Grid<std::uint8_t> reachable_;
  Grid<float> mean_ppm_;
  InformationMap information_;
  Goal goal_ = testing::GoalAt({110, geometry_.height / 2}, geometry_);
};

TEST(LeadRound, RobotsPassEachOtherWhereThereIsRoom) {
  Corridor wide(3.0);
  wide.Drives({{11.5, wide.middle_m()}, {0.5, wide.middle_m()}});
  const Plan plan = wide.Planned();
  ASSERT_THAT(plan.candidates, SizeIs(1)) << "head on, and yet a way";
  const Candidate& candidate = plan.candidates[0];
  EXPECT_GT(candidate.path.size(), 2U);
  EXPECT_LT(candidate.length_m, 1.15 * wide.Straight().length_m);
  EXPECT_LT(candidate.duration_s, 1.3 * wide.Straight().duration_s);
  double widest_m = 0.0;
  for (const Point2 vertex : candidate.path) {
    widest_m = std::max(widest_m, std::abs(vertex.y_m - wide.middle_m()));
  }
  EXPECT_GE(widest_m, 0.6);
}

TEST(LeadRound, ItDoesNotMatterWhereInTheirCellsRobotsAre) {
  Rng rng(1);
  for (int k = 0; k < 40; ++k) {
    const auto within = [&rng] { return rng.Uniform(-0.049, 0.049); };
    Corridor wide(3.0, within(), within());
    if (k % 2 == 0) {
      wide.Stands({6.0 + within(), wide.middle_m() + within()});
    } else {
      wide.Drives({{11.5 + within(), wide.middle_m() + within()}, {0.5, wide.middle_m()}});
    }
    EXPECT_THAT(wide.Planned().candidates, SizeIs(1)) << k;
  }
}

TEST(LeadRound, RobotsThatStandAreDrivenRound) {
  Corridor wide(3.0);
  wide.Stands({6.0, wide.middle_m()});
  EXPECT_THAT(wide.Planned().candidates, SizeIs(1));
  PlanningOptions wider;
  wider.robot_clearance_m = 1.5;
  EXPECT_THAT(wide.Planned(wider).candidates, SizeIs(0)) << "there is no room for that";
}

TEST(LeadRound, ThereIsNoWayRoundInANarrowOne) {
  Corridor narrow(1.0);
  narrow.Drives({{11.5, narrow.middle_m()}, {0.5, narrow.middle_m()}});
  const Plan plan = narrow.Planned();
  EXPECT_THAT(plan.candidates, SizeIs(0));
  ASSERT_THAT(plan.rejected, SizeIs(1));
  EXPECT_EQ(plan.rejected[0].reason, RejectionReason::kTraffic);
}

TEST(LeadRound, AWayThatNeedNotWaitStaysAsItIs) {
  Corridor wide(3.0);
  EXPECT_EQ(wide.Planned().candidates[0], wide.Straight()) << "alone";
  wide.Stands({6.0, wide.middle_m() + 1.2});
  EXPECT_EQ(wide.Planned().candidates[0], wide.Straight());
  PlanningOptions on_its_own;
  on_its_own.yield_to_robots = false;
  wide.Stands({6.0, wide.middle_m()});
  EXPECT_EQ(wide.Planned(on_its_own).candidates[0], wide.Straight());
}

TEST(LeadRound, AShortWaitIsBetterThanALongWay) {
  Corridor narrow(1.6);
  const double y_m = narrow.middle_m();
  narrow.Drives({{5.0, y_m - 0.6}, {5.0, y_m + 5.0}});
  const Plan plan = narrow.Planned();
  ASSERT_THAT(plan.candidates, SizeIs(1));
  EXPECT_EQ(plan.candidates[0].path, narrow.Straight().path);
}

TEST(LeadRound, OnlyBlockedWaysChangeWhereTimeDoesNotCount) {
  Corridor wide(3.0);
  PlanningOptions by_cost;
  by_cost.selection_rule = SelectionRule::kLeastCost;
  wide.Drives({{4.0, wide.middle_m()},
               {6.0, wide.middle_m()},
               {4.0, wide.middle_m()},
               {4.0, wide.middle_m() + 1.4}});
  const Plan waits = wide.Planned(by_cost);
  ASSERT_THAT(waits.candidates, SizeIs(1));
  EXPECT_EQ(waits.candidates[0].path, wide.Straight().path);
  EXPECT_GT(waits.candidates[0].duration_s, wide.Straight().duration_s + kWorthAWayRound_s);
  EXPECT_NE(wide.Planned().candidates[0].path, wide.Straight().path);
  wide.Stands({6.0, wide.middle_m()});
  EXPECT_NE(wide.Planned(by_cost).candidates[0].path, wide.Straight().path);
}

TEST(LeadRound, NoWayIsSoughtToWhatWouldNotBeChosenWhereTimeDoesNotCount) {
  Corridor wide(3.0);
  wide.Stands({6.0, wide.middle_m()});
  PlanningOptions by_cost;
  by_cost.selection_rule = SelectionRule::kLeastCost;
  const Candidate cheaper = wide.Near(0.8 * kStraightCost);
  const Plan plan = wide.Planned(by_cost, {cheaper});
  ASSERT_THAT(plan.candidates, SizeIs(1));
  EXPECT_EQ(plan.candidates[0], cheaper);
  EXPECT_THAT(plan.rejected, SizeIs(1));
  EXPECT_EQ(plan.effort.edges_evaluated, 0);

  EXPECT_THAT(wide.Planned(by_cost, {wide.Near(1.2 * kStraightCost)}).candidates, SizeIs(2));
  EXPECT_THAT(wide.Planned({}, {cheaper}).candidates, SizeIs(2)) << "it may bring more";
  by_cost.commitment_margin_share = 0.3;
  EXPECT_THAT(wide.Planned(by_cost, {cheaper}).candidates, SizeIs(2)) << "it might be kept";
}

}  // namespace way_round_test
}  // namespace plumescout
