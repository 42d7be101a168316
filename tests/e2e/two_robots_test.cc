// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Two robots share a mission and set out towards each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/mutex.h"
#include "core/belief/belief.h"
#include "core/types/event.h"
#include "tests/e2e/hall_run.h"

namespace plumescout::lab {
namespace two_robots_test {

// A claim lives at least this long, if its robot says nothing more of it.
constexpr std::int64_t kClaimGrace_ns = 30'000'000'000;

// Follows a mission's events and looks for goals that two robots hold at once. The mission's writer
// calls it, one event after the other; what it found may be read once the server is gone.
class ClaimReferee {
 public:
  void operator()(const Event& event) {
    if (const auto* received = std::get_if<ObservationReceived>(&event.body)) {
      now_ns_ = std::max(now_ns_, received->observation.sample_time_ns);
    } else if (const auto* issued = std::get_if<PlanIssued>(&event.body)) {
      OnPlan(issued->plan);
    } else if (const auto* reported = std::get_if<ProgressReported>(&event.body)) {
      held_.erase(reported->robot);
    }
  }

  const std::map<RobotId, int>& goals_given() const { return goals_given_; }
  const std::vector<std::string>& fouls() const { return fouls_; }

 private:
  struct Holding {
    Goal goal;
    std::int64_t since_ns = 0;
  };

  void OnPlan(const Plan& plan) {
    held_.erase(plan.robot);
    if (plan.chosen < 0) return;
    const Goal& goal = plan.candidates[static_cast<std::size_t>(plan.chosen)].goal;
    for (const auto& [robot, holding] : held_) {
      if (now_ns_ - holding.since_ns > kClaimGrace_ns || !ClaimCovers(holding.goal, goal)) continue;
      fouls_.push_back(absl::StrCat(plan.robot, " was sent where ", robot,
                                    " was going: ", goal.position.x_m, ", ", goal.position.y_m));
    }
    held_[plan.robot] = {goal, now_ns_};
    ++goals_given_[plan.robot];
  }

  std::int64_t now_ns_ = 0;
  std::map<RobotId, Holding> held_;
  std::map<RobotId, int> goals_given_;
  std::vector<std::string> fouls_;
};

EpisodeOptions RobotAt(const RobotId& robot, const Pose2& start) {
  EpisodeOptions options = HallOptions();
  options.robot = robot;
  options.simulated.start = start;
  return options;
}

TEST(TwoRobotsTest, NeitherWaitsForTheOtherNorGoesForItsGoal) {
  ClaimReferee referee;
  server::RegistryHooks hooks;
  hooks.make_event_sink = [&referee](const MissionId&, const MissionOptions&) {
    return [&referee](const Event& event) { referee(event); };
  };
  auto server = StartServer(0, hooks);
  ASSERT_NE(server, nullptr);
  const auto west_planner = ClientOf(*server);
  const auto east_planner = ClientOf(*server);

  absl::StatusOr<EpisodeResult> west = absl::UnknownError("has not run");
  absl::StatusOr<EpisodeResult> east = west.status();
  std::thread west_robot([&] {
    west = RunEpisode(*west_planner, GasHall(), RobotAt("west", {0.8, 3.6, 0.0}));
  });
  std::thread east_robot([&] {
    east = RunEpisode(*east_planner, GasHall(), RobotAt("east", {5.2, 3.6, M_PI}));
  });
  west_robot.join();
  east_robot.join();
  const absl::StatusOr<MapSnapshot> map = west_planner->GetMap(kHallMission);
  server.reset();

  ASSERT_TRUE(west.ok()) << west.status();
  ASSERT_TRUE(east.ok()) << east.status();
  EXPECT_EQ(west->readings_applied, west->readings_sent);
  EXPECT_EQ(east->readings_applied, east->readings_sent);
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->robots.size(), 2U);
  EXPECT_GT(referee.goals_given().at("west"), 0);
  EXPECT_GT(referee.goals_given().at("east"), 0);
  EXPECT_TRUE(referee.fouls().empty()) << referee.fouls().front();
}

}  // namespace two_robots_test
}  // namespace plumescout::lab
