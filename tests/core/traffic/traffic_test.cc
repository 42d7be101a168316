// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/traffic/traffic.h"

#include <algorithm>
#include <cmath>

#include "core/types/rng.h"
#include "gtest/gtest.h"

namespace plumescout {
namespace traffic_test {

constexpr double kRadius_m = 0.2;
constexpr double kClearance_m = 0.25;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kNow_ns = 100 * kSecond_ns;

// At 1 m/s, without turns and ramps.
Trajectory Along(const std::vector<Point2>& path) {
  Trajectory trajectory;
  for (const Point2 vertex : path) {
    if (!trajectory.waypoints.empty()) {
      trajectory.length_m += Distance_m(trajectory.waypoints.back().pose.position(), vertex);
    }
    trajectory.waypoints.push_back({{vertex.x_m, vertex.y_m, 0.0}, trajectory.length_m});
  }
  trajectory.duration_s = trajectory.length_m;
  return trajectory;
}

RobotRecord Standing(const RobotId& robot, Point2 place) {
  RobotRecord record;
  record.state.id = robot;
  record.state.radius_m = kRadius_m;
  record.state.has_pose = true;
  record.state.pose = {place.x_m, place.y_m, 0.0};
  return record;
}

// Where the way begins, departing now.
RobotRecord Driving(const RobotId& robot, Trajectory way) {
  RobotRecord record = Standing(robot, way.waypoints.front().pose.position());
  record.live_arrival_ns = kNow_ns + std::llround(way.duration_s * 1e9);
  record.live_trajectory = std::make_shared<const Trajectory>(std::move(way));
  return record;
}

Traffic TrafficFor(const Trajectory& mine, const RobotRecord& other) {
  return Traffic({{"a", Standing("a", mine.waypoints.front().pose.position())}, {"b", other}}, "a",
                 kClearance_m, kNow_ns);
}

TEST(Traffic, ARobotThatStandsIsInTheWayForGood) {
  const Trajectory way = Along({{0.0, 0.0}, {10.0, 0.0}});
  const Traffic blocked = TrafficFor(way, Standing("b", {5.0, 0.3}));
  const auto meeting = blocked.FirstMeeting(way);
  ASSERT_TRUE(meeting.has_value());
  EXPECT_EQ(meeting->robot, "b");
  EXPECT_NEAR(meeting->place.x_m, 5.0 - std::sqrt(0.65 * 0.65 - 0.3 * 0.3), 0.25);
  EXPECT_NEAR(meeting->time_s, meeting->place.x_m, 1e-9);
  EXPECT_FALSE(blocked.LeastWait_s(way).has_value());
  EXPECT_FALSE(TrafficFor(way, Standing("b", {5.0, 0.66})).FirstMeeting(way).has_value());
  EXPECT_EQ(TrafficFor(way, Standing("b", {5.0, 0.66})).LeastWait_s(way).value(), 0.0);
}

TEST(Traffic, WhoCrossesIsWaitedFor) {
  const Trajectory way = Along({{0.0, 0.0}, {6.0, 0.0}});
  const Traffic traffic = TrafficFor(way, Driving("b", Along({{3.0, -3.0}, {3.0, 9.0}})));
  EXPECT_TRUE(traffic.FirstMeeting(way).has_value());
  const std::optional<double> wait_s = traffic.LeastWait_s(way);
  ASSERT_TRUE(wait_s.has_value());
  EXPECT_GE(*wait_s, 1.0);
  EXPECT_LE(*wait_s, 4.0);
}

TEST(Traffic, AWayThatIsKeptIsWaitedForAndNoWayEndsOnIt) {
  const Trajectory way = Along({{0.0, 0.0}, {6.0, 0.0}});
  const RobotRecord waiting = Standing("b", {3.0, -3.0});
  Traffic traffic = TrafficFor(way, waiting);
  EXPECT_EQ(traffic.LeastWait_s(way), 0.0) << "it stands";
  traffic.KeepWay(waiting.state, Along({{3.0, -3.0}, {3.0, 9.0}}));
  const std::optional<double> wait_s = traffic.LeastWait_s(way);
  ASSERT_TRUE(wait_s.has_value());
  EXPECT_GE(*wait_s, 1.0);
  EXPECT_LE(*wait_s, 4.0);
  const Trajectory onto_it = Along({{0.0, 0.0}, {3.0, 0.0}});
  EXPECT_FALSE(traffic.LeastWait_s(onto_it).has_value()) << "though it is past by then";
  Traffic later = TrafficFor(way, waiting);
  Trajectory in_a_minute = Along({{3.0, -3.0}, {3.0, 9.0}});
  WaitAtStart(60.0, in_a_minute);
  later.KeepWay(waiting.state, in_a_minute);
  EXPECT_EQ(later.LeastWait_s(way), 0.0);
  const auto meeting = later.FirstMeeting(onto_it);
  ASSERT_TRUE(meeting.has_value());
  EXPECT_EQ(meeting->robot, "b");
  EXPECT_DOUBLE_EQ(meeting->time_s, 3.0);
  EXPECT_EQ(meeting->place, (Point2{3.0, 0.0}));
}

TEST(Traffic, AWaitMayBeLongerIfItIsAskedFor) {
  const Trajectory way = Along({{0.0, 0.0}, {6.0, 0.0}});
  const Trajectory to_and_fro = Along(
      {{3.0, -1.0}, {3.0, 1.0}, {3.0, -1.0}, {3.0, 1.0}, {3.0, -1.0}, {3.0, 1.0}, {3.0, 30.0}});
  const Traffic traffic = TrafficFor(way, Driving("b", to_and_fro));
  EXPECT_FALSE(traffic.LeastWait_s(way).has_value());
  const std::optional<double> wait_s = traffic.LeastWait_s(way, Traffic::kHorizon_s);
  ASSERT_TRUE(wait_s.has_value());
  EXPECT_GT(*wait_s, Traffic::kMaxWait_s);
  EXPECT_LE(*wait_s, 13.0);
}

TEST(Traffic, WhoComesHeadOnInACorridorIsNotWaitedFor) {
  const Trajectory way = Along({{0.0, 0.0}, {8.0, 0.0}});
  const Traffic traffic = TrafficFor(way, Driving("b", Along({{8.0, 0.0}, {0.5, 0.0}})));
  EXPECT_FALSE(traffic.LeastWait_s(way).has_value());
}

TEST(Traffic, NobodyStopsWhereAnotherIsToPassLater) {
  const Trajectory way = Along({{0.0, 0.0}, {2.0, 0.0}});
  const Trajectory beside = Along({{0.0, 0.0}, {0.0, 2.0}});
  const Traffic traffic = TrafficFor(way, Driving("b", Along({{14.0, 0.0}, {1.0, 0.0}})));
  EXPECT_FALSE(traffic.LeastWait_s(way).has_value());
  ASSERT_TRUE(traffic.FirstMeeting(way).has_value());
  EXPECT_GT(traffic.FirstMeeting(way)->time_s, 6.0) << "it stands there since 2 s";
  EXPECT_EQ(traffic.LeastWait_s(beside).value(), 0.0);
}

TEST(Traffic, HoldsAreWhereOthersWillBeAndUntilWhen) {
  const Trajectory way = Along({{0.0, 0.0}, {2.0, 0.0}});
  const auto holds = TrafficFor(way, Driving("b", Along({{5.0, 0.0}, {5.0, 4.0}}))).Holds();
  ASSERT_GT(holds.size(), 16U);
  EXPECT_EQ(holds.front().place, (Point2{5.0, 0.0}));
  EXPECT_DOUBLE_EQ(holds.front().apart_m, 2.0 * kRadius_m + kClearance_m);
  for (std::size_t i = 1; i + 1 < holds.size(); ++i) {
    EXPECT_GE(holds[i].place.y_m, holds[i - 1].place.y_m);
    EXPECT_GT(holds[i].until_s, holds[i].place.y_m + 1.0);
  }
  EXPECT_EQ(holds.back().place, (Point2{5.0, 4.0}));
  EXPECT_TRUE(std::isinf(holds.back().until_s));
  const auto standing = TrafficFor(way, Standing("b", {5.0, 1.0})).Holds();
  ASSERT_EQ(standing.size(), 1U);
  EXPECT_TRUE(std::isinf(standing[0].until_s));
}

TEST(Traffic, OneMayFollowAnother) {
  const Trajectory way = Along({{0.0, 0.0}, {8.0, 0.0}});
  const Traffic traffic = TrafficFor(way, Driving("b", Along({{1.0, 0.0}, {20.0, 0.0}})));
  const std::optional<double> wait_s = traffic.LeastWait_s(way);
  ASSERT_TRUE(wait_s.has_value());
  EXPECT_LE(*wait_s, 3.0);
}

TEST(Traffic, RobotsThatStandTooNearMayPart) {
  const Trajectory away = Along({{0.0, 0.0}, {-5.0, 0.0}});
  const Trajectory through = Along({{0.0, 0.0}, {5.0, 0.0}});
  const Traffic traffic = TrafficFor(away, Standing("b", {0.5, 0.0}));
  EXPECT_EQ(traffic.LeastWait_s(away).value(), 0.0);
  EXPECT_FALSE(traffic.LeastWait_s(through).has_value());
}

TEST(Traffic, WhoHasNoPoseIsNotThere) {
  const Trajectory way = Along({{0.0, 0.0}, {5.0, 0.0}});
  RobotRecord unseen = Standing("b", {2.0, 0.0});
  unseen.state.has_pose = false;
  EXPECT_FALSE(TrafficFor(way, unseen).FirstMeeting(way).has_value());
  EXPECT_FALSE(TrafficFor(way, Standing("b", {2.0, 0.0})).FirstMeeting(Trajectory()).has_value());
}

TEST(Traffic, WhoIsSilentStandsWhereItWasForAWhile) {
  const Trajectory way = Along({{0.0, 0.0}, {10.0, 0.0}});
  RobotRecord silent = Standing("b", {5.0, 0.3});
  silent.state.silent = true;
  silent.heard_ns = kNow_ns - 119 * kSecond_ns;
  EXPECT_FALSE(TrafficFor(way, silent).LeastWait_s(way).has_value());
  silent.heard_ns = kNow_ns - 121 * kSecond_ns;
  EXPECT_FALSE(TrafficFor(way, silent).FirstMeeting(way).has_value());
  silent.state.silent = false;
  EXPECT_FALSE(TrafficFor(way, silent).LeastWait_s(way).has_value()) << "nobody else was heard";
}

TEST(Traffic, WhoStrayedStandsWhereItIs) {
  const Trajectory way = Along({{0.0, 0.0}, {10.0, 0.0}});
  RobotRecord strayed = Driving("b", Along({{3.0, -5.0}, {3.0, -9.0}}));
  EXPECT_FALSE(TrafficFor(way, strayed).FirstMeeting(way).has_value());
  strayed.state.pose = {5.0, 0.2, 0.0};
  EXPECT_FALSE(TrafficFor(way, strayed).LeastWait_s(way).has_value());
  RobotRecord stuck = Driving("b", Along({{5.0, 0.0}, {5.0, -9.0}}));
  EXPECT_TRUE(TrafficFor(way, stuck).LeastWait_s(way).has_value());
  stuck.live_arrival_ns -= 60 * kSecond_ns;
  EXPECT_FALSE(TrafficFor(way, stuck).LeastWait_s(way).has_value()) << "it does not come";
}

TEST(Traffic, APlanMayBeginFartherOnThanTheRobotIs) {
  const Trajectory way = Along({{0.0, 0.0}, {10.0, 0.0}});
  RobotRecord coming = Driving("b", Along({{3.0, -3.0}, {3.0, 9.0}}));
  coming.state.pose = {3.0, -4.5, 0.0};
  EXPECT_TRUE(IsOnItsWay(coming, kNow_ns));
  EXPECT_TRUE(TrafficFor(way, coming).FirstMeeting(way).has_value());
  EXPECT_FALSE(IsOnItsWay(coming, kNow_ns + 3 * kSecond_ns)) << "it does not come";
  coming.state.pose = {3.0, -5.5, 0.0};
  EXPECT_FALSE(IsOnItsWay(coming, kNow_ns));
  coming.state.pose = {4.0, -1.5, 0.0};
  EXPECT_FALSE(IsOnItsWay(coming, kNow_ns)) << "it has set out, and strayed";
}

TEST(Traffic, OnTimeIsAnotherQuestion) {
  const Trajectory way = Along({{0.0, 0.0}, {6.0, 0.0}});
  const RobotRecord ahead = Driving("b", Along({{3.0, -1.8}, {3.0, 9.0}}));  // 1.2 s before
  EXPECT_TRUE(TrafficFor(way, ahead).FirstMeeting(way).has_value());
  const Traffic on_time({{"a", Standing("a", {0.0, 0.0})}, {"b", ahead}}, "a", 0.1, kNow_ns,
                        Traffic::Others::kOnTime);
  EXPECT_FALSE(on_time.FirstMeeting(way).has_value());
}

// Sampled finely: who is let go meets nobody who is on time, or early or late by the least of what
// is reckoned with.
TEST(Traffic, NobodyIsMetByRobotsThatKeepToTheirTimes) {
  Rng rng(7);
  int departures = 0;
  int waits = 0;
  for (int i = 0; i < 300; ++i) {
    const auto place = [&] { return Point2{rng.Uniform(0.0, 8.0), rng.Uniform(0.0, 8.0)}; };
    Trajectory mine = Along({place(), place(), place()});
    const RobotRecord other = Driving("b", Along({place(), place(), place()}));
    const double apart_m =
        Distance_m(mine.waypoints.front().pose.position(), other.state.pose.position());
    const std::optional<double> wait_s = TrafficFor(mine, other).LeastWait_s(mine);
    if (!wait_s || apart_m < 0.7) continue;
    ++departures;
    if (*wait_s > 0.0) ++waits;
    WaitAtStart(*wait_s, mine);
    for (const double early_s : {0.0, 0.4, -0.9}) {
      double nearest_m = apart_m;
      for (double time_s = 0.0; time_s < std::min(Traffic::kHorizon_s, mine.duration_s);
           time_s += 0.01) {
        nearest_m = std::min(
            nearest_m, Distance_m(PoseAt(mine, time_s).position(),
                                  PoseAt(*other.live_trajectory, time_s + early_s).position()));
      }
      EXPECT_GE(nearest_m, 2 * kRadius_m + kClearance_m - 0.1) << i << " early by " << early_s;
    }
  }
  EXPECT_GT(departures, 150);
  EXPECT_GT(waits, 20);
}

TEST(Traffic, ProgressGoesByThePoseAndWhileStandingByTheTime) {
  Trajectory way = Along({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}});
  WaitAtStart(3.0, way);
  EXPECT_EQ(way.duration_s, 11.0);
  RobotRecord record = Driving("b", way);
  EXPECT_EQ(Progress_s(record, kNow_ns), 0.0);
  EXPECT_EQ(Progress_s(record, kNow_ns + 2 * kSecond_ns), 2.0);
  EXPECT_EQ(Progress_s(record, kNow_ns + 9 * kSecond_ns), 3.0) << "it has not left yet";
  record.state.pose = {0.1, 0.05, 0.0};
  EXPECT_EQ(Progress_s(record, kNow_ns + 2 * kSecond_ns), 2.0) << "poses err a little";
  record.state.pose = {0.2, -0.15, 0.0};
  EXPECT_NEAR(Progress_s(record, kNow_ns + kSecond_ns / 10), 0.1, 1e-9) << "it has just come";
  record.state.pose = {2.0, 0.1, 0.0};
  EXPECT_NEAR(Progress_s(record, kNow_ns + 9 * kSecond_ns), 5.0, 1e-9) << "it is late";
}

TEST(Traffic, WhoComesBackWhereItWentIsOnItsWayBack) {
  RobotRecord record = Driving("b", Along({{0.0, 0.0}, {6.0, 0.0}, {0.0, 0.0}}));
  record.state.pose = {2.0, 0.0, 0.0};
  EXPECT_NEAR(Progress_s(record, kNow_ns + 10 * kSecond_ns), 2.0, 1e-9);
  record.live_gone_s = 9.5;
  EXPECT_NEAR(Progress_s(record, kNow_ns + 10 * kSecond_ns), 10.0, 1e-9);
  EXPECT_NEAR(Lateness_s(record, kNow_ns + 10 * kSecond_ns), 0.0, 1e-9);
}

TEST(Traffic, KeepsFartherFromRobotsWhoseFramesAreDoubtful) {
  const Trajectory mine = Along({{0, 0}, {6, 0}});
  RobotRecord other = Standing("b", {3.0, 0.9});
  EXPECT_FALSE(TrafficFor(mine, other).FirstMeeting(mine).has_value());
  other.state.frame.position_stddev_m = 0.09;  // 2.5 of them are less than the clearance
  EXPECT_FALSE(TrafficFor(mine, other).FirstMeeting(mine).has_value());
  other.state.frame.position_stddev_m = 0.3;
  EXPECT_TRUE(TrafficFor(mine, other).FirstMeeting(mine).has_value());
}

TEST(Traffic, OfAWayThatIsDrivenTheRestCounts) {
  const Trajectory way = Along({{0.0, 0.0}, {10.0, 0.0}});
  const Traffic traffic = TrafficFor(way, Standing("b", {5.0, 0.0}));
  const auto meeting = traffic.FirstMeeting(way, 3.0);
  ASSERT_TRUE(meeting.has_value());
  EXPECT_LT(meeting->time_s, 2.0);
  EXPECT_NEAR(meeting->place.x_m, 3.0 + meeting->time_s, 1e-9);
  EXPECT_FALSE(traffic.FirstMeeting(way, 6.0).has_value());
  EXPECT_FALSE(traffic.FirstMeeting(way, 20.0).has_value());
}

TEST(Traffic, WhoWasNotHeardOfForAWhileMayHaveDrivenOn) {
  RobotRecord other = Driving("b", Along({{-12.0, 0.0}, {3.0, 0.0}, {3.0, 9.0}}));
  other.live_arrival_ns -= 15'000'000'000;  // it set out 15 s ago, and told of 1 m alone
  other.state.pose.x_m = -11.0;
  const Trajectory way = Along({{0.0, 3.0}, {6.0, 3.0}});
  EXPECT_FALSE(TrafficFor(way, other).FirstMeeting(way).has_value());
  other.heard_ns = kNow_ns - 14'000'000'000;
  const auto meeting = TrafficFor(way, other).FirstMeeting(way);
  ASSERT_TRUE(meeting.has_value());
  EXPECT_EQ(meeting->robot, "b");
  other.heard_ns = kNow_ns - 500'000'000;
  EXPECT_FALSE(TrafficFor(way, other).FirstMeeting(way).has_value()) << "poses come, it is late";
}

}  // namespace traffic_test
}  // namespace plumescout
