// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/anticipation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/gas/gas_map.h"
#include "core/plan/selection/expected_information.h"
#include "core/plan/trajectory_timing.h"
#include "tests/support/strategy_case.h"

namespace plumescout {
namespace anticipation_test {

using testing::For;
using testing::TryPlan;

constexpr std::int64_t kNow_ns = 50'000'000'000;

// An empty hall of 16 m by 6 m, read in one place, in which "r" stands in the middle.
Belief Hall() {
  const Grid<CellState> states(GridGeometry{0.0, 0.0, 0.1, 160, 60}, CellState::kFree);
  GasMap gas{GasOptions()};
  gas.Add(0, {8.0, 3.0}, {1.0, {}});
  EXPECT_TRUE(gas.Refresh(states, 0).ok());
  Belief belief;
  belief.sample_time_ns = kNow_ns;
  belief.options = std::make_shared<const MissionOptions>();
  belief.occupancy = std::make_shared<const Grid<CellState>>(states);
  belief.traversable = std::make_shared<const Grid<std::uint8_t>>(states.geometry(), 1);
  belief.sampled = std::make_shared<const Grid<std::uint8_t>>(states.geometry(), 0);
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(gas.mean_ppm());
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(gas.variance_ppm2());
  belief.gas_what_if = gas.what_if();
  belief.gas_counters.readings = 1;
  RobotRecord& robot = belief.robots["r"];
  robot.state.id = "r";
  robot.state.radius_m = 0.2;
  robot.state.has_pose = true;
  robot.state.pose = {8.0, 3.0, 0.0};
  return belief;
}

// Another robot at the beginning of its way.
void AddRobot(const RobotId& id, const std::vector<Point2>& way, Belief& belief) {
  RobotRecord& robot = belief.robots[id];
  robot.state = belief.robots.at("r").state;
  robot.state.id = id;
  robot.state.pose = {way.front().x_m, way.front().y_m, 0.0};
  const Trajectory trajectory = TimeTrajectory(way, 0.0, {});
  robot.live_trajectory = std::make_shared<const Trajectory>(trajectory);
  robot.live_arrival_ns = kNow_ns + std::llround(trajectory.duration_s * 1e9);
}

using Promises = std::vector<ForeseenCell>;

Promises Promised(const Belief& belief) { return PromisedReadings(belief, "r", {}); }

double PrecisionSum(const Promises& promises) {
  double sum = 0.0;
  for (const ForeseenCell& reading : promises) sum += reading.precision_per_ppm2;
  return sum;
}

TEST(PromisedReadings, AreThoseOnTheWayAhead) {
  Belief belief = Hall();
  AddRobot("b", {{1.0, 1.0}, {6.0, 1.0}}, belief);  // 4 s at 1.25 m/s, two readings a second
  const Promises all = Promised(belief);
  ASSERT_EQ(all.size(), 8U);
  EXPECT_EQ(all.back().cell, belief.geometry().CellAt({6.0, 1.0}));
  EXPECT_EQ(all.front().precision_per_ppm2, belief.options->gas.observation_precision_per_ppm2);
  belief.robots["b"].state.pose.x_m = 3.5;
  belief.sample_time_ns += 2'000'000'000;
  EXPECT_EQ(Promised(belief).size(), 4U) << "by its progress";
}

TEST(PromisedReadings, AreNoneOfWhoIsAloneStandsIsSilentStrayedOrLost) {
  Belief belief = Hall();
  AddRobot("r", {{8.0, 3.0}, {12.0, 3.0}}, belief);
  EXPECT_TRUE(Promised(belief).empty()) << "its own plan";
  AddRobot("b", {{1.0, 1.0}, {6.0, 1.0}}, belief);
  Belief strayed = belief;
  strayed.robots["b"].state.pose = {3.0, 2.0, 0.0};
  EXPECT_TRUE(Promised(strayed).empty());
  Belief silent = belief;
  silent.robots["b"].state.silent = true;
  EXPECT_TRUE(Promised(silent).empty());
  Belief lost = belief;
  lost.robots["b"].state.frame_suspect = true;
  EXPECT_TRUE(Promised(lost).empty());
  Belief overdue = belief;
  overdue.sample_time_ns += 60'000'000'000;
  EXPECT_TRUE(Promised(overdue).empty());
  belief.robots["b"].live_trajectory = nullptr;
  EXPECT_TRUE(Promised(belief).empty());
}

TEST(PromisedReadings, CountLessFarAheadAndOfWhoFallsBehind) {
  Belief belief = Hall();
  AddRobot("b", {{0.5, 0.5}, {15.5, 0.5}, {15.5, 5.5}, {0.5, 5.5}}, belief);  // 28 s
  const double on_time = PrecisionSum(Promised(belief));
  const Promises promises = Promised(belief);
  EXPECT_NEAR(promises.back().precision_per_ppm2 / promises.front().precision_per_ppm2,
              std::exp(-18.0 / 20.0), 0.02);
  belief.sample_time_ns += 20'000'000'000;  // and it has not moved
  EXPECT_LT(PrecisionSum(Promised(belief)), 0.7 * on_time);
}

TEST(PromisedReadings, ArePutTogetherWhereThereAreMany) {
  Belief belief = Hall();
  for (int k = 0; k < 7; ++k) {
    const double y_m = 0.5 + 0.8 * k;
    AddRobot("b" + std::to_string(k), {{0.5, y_m}, {12.5, y_m}}, belief);  // 19 readings each
  }
  const Promises promises = Promised(belief);
  EXPECT_LE(promises.size(), kMostPromised);
  EXPECT_GE(promises.size(), kMostPromised / 2);
  EXPECT_NEAR(PrecisionSum(promises), 7 * 19 * belief.options->gas.observation_precision_per_ppm2,
              1e-6);
}

TEST(PromisedReadings, AreBoundedWhateverTheOptionsSay) {
  Belief belief = Hall();
  AddRobot("b", {{0.5, 0.5}, {15.5, 0.5}}, belief);  // 12 s
  PlanningOptions often;
  often.reading_rate_hz = 1000.0;
  const Promises promises = PromisedReadings(belief, "r", often);
  EXPECT_LE(promises.size(), kMostPromised);
  const double precision = belief.options->gas.observation_precision_per_ppm2;
  EXPECT_NEAR(PrecisionSum(promises), 12'000 * precision, 500.0 * precision);
  for (int k = 0; k < 100; ++k) {
    AddRobot("c" + std::to_string(k), {{0.5, 0.5}, {12.5, 0.5}}, belief);
  }
  EXPECT_LE(Promised(belief).size(), kMostPromised);
  RobotRecord& slow = belief.robots["b"];
  Trajectory crawl = *slow.live_trajectory;
  for (Waypoint& waypoint : crawl.waypoints) waypoint.arrival_time_s *= 1e5;
  crawl.duration_s *= 1e5;
  slow.live_arrival_ns = kNow_ns + std::llround(crawl.duration_s * 1e9);
  slow.live_trajectory = std::make_shared<const Trajectory>(crawl);
  for (const ForeseenCell& reading : Promised(belief)) {
    EXPECT_GT(reading.precision_per_ppm2, 0.0);
  }
}

TEST(Anticipate, PricesTheUnionLessWhatIsPromised) {
  Belief belief = Hall();
  AddRobot("b", {{2.0, 2.0}, {7.0, 2.0}}, belief);
  const std::optional<Belief> ahead = Anticipate(belief, "r", {});
  ASSERT_TRUE(ahead.has_value());
  EXPECT_EQ(ahead->gas_mean_ppm, belief.gas_mean_ppm);
  std::vector<Cell> theirs;
  for (const ForeseenCell& reading : Promised(belief)) theirs.push_back(reading.cell);
  std::vector<Cell> own = {{30, 22}, {50, 30}, {120, 40}};
  std::vector<Cell> both = theirs;
  both.insert(both.end(), own.begin(), own.end());
  ExpectedInformation now(belief);
  const double conditioned = ExpectedInformation(*ahead).Of(own).value();
  const double difference = now.Of(both).value() - now.Of(theirs).value();
  EXPECT_NEAR(conditioned / difference, 1.0, 1e-3);
  EXPECT_LT(conditioned, 0.9 * now.Of(own).value());
}

TEST(Anticipate, HasNothingToSayWithoutPromisesOrField) {
  Belief belief = Hall();
  EXPECT_FALSE(Anticipate(belief, "r", {}).has_value());
  AddRobot("b", {{2.0, 2.0}, {7.0, 2.0}}, belief);
  EXPECT_TRUE(Anticipate(belief, "r", {}).has_value());
  EXPECT_FALSE(Anticipate(belief, "b", {}).has_value());
  belief.gas_what_if = nullptr;
  EXPECT_FALSE(Anticipate(belief, "r", {}).has_value());
}

TEST(Anticipate, KnowsWhereTheFieldLiesOnAMapThatHasGrown) {
  Belief belief = Hall();
  AddRobot("b", {{2.0, 2.0}, {7.0, 2.0}}, belief);
  const std::optional<Belief> before = Anticipate(belief, "r", {});
  const GridGeometry grown{-1.0, -0.5, 0.1, 180, 70};
  Grid<float> variance(grown, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < belief.gas_variance_ppm2->size(); ++i) {
    const Cell cell = belief.geometry().CellAtIndex(i);
    variance[Cell{cell.x + 10, cell.y + 5}] = (*belief.gas_variance_ppm2)[i];
  }
  belief.occupancy = std::make_shared<const Grid<CellState>>(grown, CellState::kFree);
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(variance);
  const std::optional<Belief> after = Anticipate(belief, "r", {});
  for (const Cell cell : {Cell{20, 20}, Cell{40, 22}, Cell{100, 50}}) {
    EXPECT_EQ((*after->gas_variance_ppm2)[(Cell{cell.x + 10, cell.y + 5})],
              (*before->gas_variance_ppm2)[cell]);
  }
  EXPECT_TRUE(std::isnan((*after->gas_variance_ppm2)[(Cell{0, 0})]));
}

TEST(PromisedSight, FallsWithTheDistanceAndEndsAtWalls) {
  Belief belief = Hall();
  AddRobot("b", {{1.0, 1.0}, {6.0, 1.0}}, belief);  // 4 s
  const PromisedSight sight(belief, "r");
  EXPECT_DOUBLE_EQ(sight.ShareOf({6.0, 1.0}), 1.0);
  EXPECT_DOUBLE_EQ(sight.ShareOf({10.0, 1.0}), 0.5);
  EXPECT_DOUBLE_EQ(sight.ShareOf({6.0, 5.0}), 0.5);
  EXPECT_EQ(sight.ShareOf({14.1, 1.0}), 0.0) << "out of range";
  EXPECT_DOUBLE_EQ(PromisedSight(belief, "r", 16.0).ShareOf({10.0, 1.0}), 0.75);
  auto walled = std::make_shared<Grid<CellState>>(*belief.occupancy);
  for (int y = 0; y < 60; ++y) (*walled)[Cell{80, y}] = CellState::kOccupied;
  belief.occupancy = walled;
  EXPECT_EQ(PromisedSight(belief, "r").ShareOf({10.0, 1.0}), 0.0);
  EXPECT_DOUBLE_EQ(PromisedSight(belief, "r").ShareOf({6.0, 5.0}), 0.5);
}

TEST(PromisedSight, IsOfWaysAheadAndFadesAsPromisesDo) {
  Belief belief = Hall();
  AddRobot("b", {{1.0, 1.0}, {6.0, 1.0}}, belief);
  EXPECT_EQ(PromisedSight(belief, "b").ShareOf({6.0, 1.0}), 0.0) << "its own plan";
  Belief late = belief;
  late.sample_time_ns += 26'000'000'000;  // and it has not moved: the end is 30 s after its time
  EXPECT_NEAR(PromisedSight(late, "r").ShareOf({6.0, 1.0}), std::exp(-1.0), 0.01);
  Belief silent = belief;
  silent.robots["b"].state.silent = true;
  EXPECT_EQ(PromisedSight(silent, "r").ShareOf({6.0, 1.0}), 0.0);
  belief.robots["b"].state.pose.x_m = 5.0;
  EXPECT_DOUBLE_EQ(PromisedSight(belief, "r").ShareOf({1.0, 1.0}), 0.5) << "from 4 m past it";
}

TEST(Anticipation, LeavesToOthersTheEdgesThatTheyAreToSee) {
  Belief belief = Hall();
  auto known = std::make_shared<Grid<CellState>>(*belief.occupancy);
  auto traversable = std::make_shared<Grid<std::uint8_t>>(*belief.traversable);
  for (std::size_t i = 0; i < known->size(); ++i) {
    const int x = known->geometry().CellAtIndex(i).x;
    if (x >= 10 && x < 150) continue;
    (*known)[i] = CellState::kUnknown;
    (*traversable)[i] = 0;
  }
  belief.occupancy = known;
  belief.traversable = traversable;
  AddRobot("b", {{9.0, 1.0}, {14.5, 2.0}}, belief);
  PlanningOptions options;
  const absl::StatusOr<Plan> beside = TryPlan(belief, For("r", 3), options);
  ASSERT_TRUE(beside.ok()) << beside.status();
  options.anticipate_robots = false;
  const absl::StatusOr<Plan> alone = TryPlan(belief, For("r", 3), options);
  ASSERT_TRUE(alone.ok());
  const auto share_of = [](const Plan& plan, bool east) {
    double share = -1.0;  // there is no such edge among the candidates
    for (const Candidate& c : plan.candidates) {
      const bool is_it =
          c.goal.kind == GoalKind::kOccupancyFrontier && (c.goal.centroid.x_m > 8.0) == east;
      if (is_it) share = c.unseen_share;
    }
    return share;
  };
  EXPECT_EQ(share_of(*beside, false), 1.0);
  EXPECT_GE(share_of(*beside, true), 0.0);
  EXPECT_LT(share_of(*beside, true), 0.25);
  EXPECT_EQ(share_of(*alone, false), 1.0);
  EXPECT_EQ(share_of(*alone, true), 1.0);
}

TEST(Anticipation, SendsARobotElsewhereThanWhereAnotherIsAboutToRead) {
  Belief belief = Hall();
  AddRobot("b", {{9.0, 3.0}, {15.0, 3.0}, {15.0, 1.0}, {10.0, 1.0}, {10.0, 5.0}, {14.0, 5.0}},
           belief);
  PlanningOptions options;
  const absl::StatusOr<Plan> beside = TryPlan(belief, For("r", 3), options);
  ASSERT_TRUE(beside.ok()) << beside.status();
  ASSERT_GE(beside->chosen, 0);
  EXPECT_LT(testing::Chosen(*beside).goal.position.x_m, 8.0) << "the west is nobody's";
  options.anticipate_robots = false;
  const absl::StatusOr<Plan> alone = TryPlan(belief, For("r", 3), options);
  ASSERT_TRUE(alone.ok());
  const auto easterly = [](const Plan& plan) {
    int count = 0;
    for (const Candidate& c : plan.candidates) count += c.goal.position.x_m > 9.5 ? 1 : 0;
    return count;
  };
  EXPECT_GT(easterly(*alone), easterly(*beside));
}

TEST(Anticipation, HelpsOthersRatherThanDriveAboutAtRandom) {
  Belief belief = Hall();
  GasMap gas{GasOptions()};
  for (int x = 0; x <= 160; x += 3) {
    for (int y = 0; y <= 60; y += 3) {
      const Point2 place = belief.geometry().Center({std::min(x, 159), std::min(y, 59)});
      if (Distance_m(place, {12.0, 3.0}) > 0.8) gas.Add(0, place, {0.0, {}});
    }
  }
  ASSERT_TRUE(gas.Refresh(*belief.occupancy, 0).ok());
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(gas.mean_ppm());
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(gas.variance_ppm2());
  belief.gas_what_if = gas.what_if();
  AddRobot("b", {{11.4, 3.0}, {12.6, 3.0}, {12.6, 3.4}, {11.4, 3.4}, {11.4, 2.6}, {12.6, 2.6}},
           belief);
  PlanningOptions options;
  options.reading_rate_hz = 10.0;
  const absl::StatusOr<Plan> plan = TryPlan(belief, For("r", 3), options);
  ASSERT_TRUE(plan.ok());
  ASSERT_GE(plan->chosen, 0);
  EXPECT_EQ(testing::Chosen(*plan).goal.kind, GoalKind::kInformation);
  EXPECT_LT(Distance_m(testing::Chosen(*plan).goal.position, {12.0, 3.0}), 1.5);
}

}  // namespace anticipation_test
}  // namespace plumescout
