// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Teams of which one falls silent, leaves, loses its link, or has a wrong clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "lab/local/local_planner_client.h"
#include "lab/sim/episode.h"
#include "tests/lab/sim/fake_service.h"
#include "tests/lab/sim/small_scene.h"

namespace plumescout::lab {
namespace episode_outages_test {

constexpr char kOther[] = "robot-2";
constexpr double kTick_s = 0.1;

struct TeamRun {
  TeamResult team;
  std::vector<Event> events;
  std::shared_ptr<const Belief> belief;
};

// Twelve seconds of two robots in the small room; the second one has the traits.
TeamRun RunTwo(const RobotTraits& traits, bool with_clocks = false) {
  TeamRun run;
  EpisodeOptions options;
  options.mission = "study";
  options.create = MissionOptions{};
  options.duration_s = 12.0;
  options.plan_budget = absl::InfiniteDuration();
  LocalOptions local;
  local.on_event = [&run](const Event& event) { run.events.push_back(event); };
  if (with_clocks) {
    options.world_time_ns = std::make_shared<std::atomic<std::int64_t>>(0);
    local.mission_clock_ns = [time_ns = options.world_time_ns] { return time_ns->load(); };
  }
  LocalPlannerClient planner(local);
  auto team =
      RunTeamEpisode(planner, SmallWorld(), options, {{kOther, {1.0, 2.5, 0.0}, 2, traits}});
  EXPECT_TRUE(team.ok()) << team.status();
  if (team.ok()) run.team = *std::move(team);
  const auto belief = planner.GetBelief("study");
  EXPECT_TRUE(belief.ok()) << belief.status();
  if (belief.ok()) run.belief = *belief;
  return run;
}

RobotTraits With(const Outage& outage) {
  RobotTraits traits;
  traits.outages = {outage};
  return traits;
}

// Silent from 4 s to 5 s, and then without a link for so long.
RobotTraits BackWithoutALink(double for_s) {
  RobotTraits traits;
  traits.outages = {{OutageKind::kSilent, 4.0, 1.0}, {OutageKind::kLinkLost, 5.0, for_s}};
  return traits;
}

double Seconds(std::int64_t time_ns) {
  return 1e-9 * static_cast<double>(time_ns - SimulatedRobotOptions{}.start_time_ns);
}

// Sample times of what a robot said, in the order in which it arrived.
std::vector<double> TimesOf(const RobotId& robot, const std::vector<Event>& events) {
  std::vector<double> times_s;
  for (const Event& event : events) {
    const auto* received = std::get_if<ObservationReceived>(&event.body);
    if (received == nullptr || received->robot != robot) continue;
    times_s.push_back(Seconds(received->observation.sample_time_ns));
  }
  return times_s;
}

template <typename Body>
int CountOf(const RobotId& robot, const std::vector<Event>& events) {
  return static_cast<int>(std::count_if(events.begin(), events.end(), [&](const Event& event) {
    const auto* body = std::get_if<Body>(&event.body);
    return body != nullptr && body->robot == robot;
  }));
}

TEST(EpisodeOutages, WhoFellSilentComesBackByRegisteringAgain) {
  const TeamRun run = RunTwo(With({OutageKind::kSilent, 4.0, 3.0}));
  ASSERT_EQ(run.team.robots.size(), 2u);
  EXPECT_EQ(CountOf<RobotRegistered>(kOther, run.events), 2);
  EXPECT_EQ(CountOf<RobotRemoved>(kOther, run.events), 0);
  const std::vector<double> times_s = TimesOf(kOther, run.events);
  const auto said_within = [&](double from_s, double to_s) {
    return std::count_if(times_s.begin(), times_s.end(),
                         [&](double time_s) { return time_s > from_s && time_s < to_s; });
  };
  EXPECT_GT(said_within(0.0, 4.0 - kTick_s / 2), 40);  // ten scans a second
  EXPECT_EQ(said_within(4.0 - kTick_s / 2, 7.0 - kTick_s / 2), 0);
  EXPECT_GT(said_within(7.0 - kTick_s / 2, 12.0), 45);
  const EpisodeResult& other = run.team.robots[1];
  EXPECT_FALSE(other.absent);
  EXPECT_NEAR(other.simulated_s, 12.0, 2 * kTick_s);
  EXPECT_EQ(other.readings_applied, static_cast<std::int64_t>(times_s.size()));
  EXPECT_EQ(other.readings_sent, other.readings_applied);
  for (const DrivenPose& at : other.path) EXPECT_FALSE(at.time_s > 4.05 && at.time_s < 6.95);
}

TEST(EpisodeOutages, WhoComesBackWithoutALinkJoinsOnceItHasOne) {
  const TeamRun run = RunTwo(BackWithoutALink(2.0));
  ASSERT_EQ(run.team.robots.size(), 2u);
  EXPECT_EQ(CountOf<RobotRegistered>(kOther, run.events), 2);
  const EpisodeResult& other = run.team.robots[1];
  EXPECT_FALSE(other.absent);
  EXPECT_NEAR(other.simulated_s, 12.0, 2 * kTick_s);
  EXPECT_EQ(other.readings_sent, other.readings_applied);
  for (const double time_s : TimesOf(kOther, run.events)) {
    EXPECT_FALSE(time_s > 4.0 - kTick_s / 2 && time_s < 7.0 - kTick_s / 2) << time_s;
  }
  EXPECT_GT(TimesOf(kOther, run.events).back(), 11.5);
}

TEST(EpisodeOutages, WhoHasNoLinkUntilTheEndIsAbsent) {
  const TeamRun run = RunTwo(BackWithoutALink(20.0));
  ASSERT_EQ(run.team.robots.size(), 2u);
  EXPECT_EQ(CountOf<RobotRegistered>(kOther, run.events), 1);
  EXPECT_TRUE(run.team.robots[1].absent);
  EXPECT_FALSE(run.team.robots[0].absent);
  EXPECT_NEAR(run.team.robots[0].simulated_s, 12.0, 2 * kTick_s);
}

TEST(EpisodeOutages, WhoLeavesForGoodIsNotWaitedFor) {
  const TeamRun run = RunTwo(With({OutageKind::kLeaves, 4.0}));
  ASSERT_EQ(run.team.robots.size(), 2u);
  EXPECT_EQ(CountOf<RobotRemoved>(kOther, run.events), 1);
  EXPECT_TRUE(run.team.robots[1].absent);
  EXPECT_FALSE(run.team.robots[0].absent);
  EXPECT_NEAR(run.team.robots[0].simulated_s, 12.0, 2 * kTick_s);
  EXPECT_FALSE(run.belief->robots.contains(kOther));
  EXPECT_FALSE(IsComplete(run.team));
}

TEST(EpisodeOutages, WhatWasSensedWithoutALinkComesAfterwards) {
  const TeamRun run = RunTwo(With({OutageKind::kLinkLost, 4.0, 3.0}));
  ASSERT_EQ(run.team.robots.size(), 2u);
  const EpisodeResult& other = run.team.robots[1];
  EXPECT_EQ(other.readings_applied, other.readings_sent);
  EXPECT_NEAR(static_cast<double>(other.readings_sent), 12.0 * 12.0, 4.0);
  EXPECT_EQ(CountOf<RobotRegistered>(kOther, run.events), 1);
  // Everything of those three seconds arrived after what the first robot said in them.
  double first_robot_s = 0.0;
  for (const Event& event : run.events) {
    const auto* received = std::get_if<ObservationReceived>(&event.body);
    if (received == nullptr) continue;
    const double time_s = Seconds(received->observation.sample_time_ns);
    if (received->robot != kOther) {
      first_robot_s = std::max(first_robot_s, time_s);
    } else if (time_s > 4.0 - kTick_s / 2 && time_s < 7.0 - kTick_s / 2) {
      EXPECT_GT(first_robot_s, 7.0 - 2 * kTick_s) << time_s;
    }
  }
}

TEST(EpisodeOutages, AreRepeatableInLockstep) {
  const auto path = [](const TeamRun& run, std::size_t robot) {
    std::vector<Pose2> poses;
    for (const DrivenPose& at : run.team.robots.at(robot).path) poses.push_back(at.pose);
    return poses;
  };
  for (const OutageKind kind : {OutageKind::kLinkLost, OutageKind::kSilent, OutageKind::kLeaves}) {
    const TeamRun once = RunTwo(With({kind, 3.0, 4.0}));
    const TeamRun again = RunTwo(With({kind, 3.0, 4.0}));
    ASSERT_TRUE(once.team.robots.size() == 2 && again.team.robots.size() == 2);
    for (const std::size_t robot : {0u, 1u}) EXPECT_TRUE(path(once, robot) == path(again, robot));
    EXPECT_EQ(once.belief->revision, again.belief->revision);
  }
}

TEST(EpisodeOutages, AWrongClockIsFoundOut) {
  RobotTraits traits;
  traits.clock = {.offset_s = 3600.0, .drift_ppm = 100.0};
  const TeamRun run = RunTwo(traits, /*with_clocks=*/true);
  ASSERT_EQ(run.team.robots.size(), 2u);
  EXPECT_EQ(CountOf<ClockOffsetNoted>(kOther, run.events), 1) << "1.2 ms of drift are none";
  EXPECT_EQ(CountOf<ClockOffsetNoted>("robot-1", run.events), 0);
  EXPECT_NEAR(1e-9 * static_cast<double>(run.belief->robots.at(kOther).state.clock_offset_ns),
              -3600.0, 1e-3);
  EXPECT_NEAR(Seconds(run.belief->sample_time_ns), 12.0, 2 * kTick_s);
  EXPECT_GT(TimesOf(kOther, run.events).front(), 3599.0) << "recorded as it was sent";
}

TEST(EpisodeOutages, SecondsOfARunAreTheWorldsAndNotOfAWrongClock) {
  RobotTraits traits;
  traits.clock = {.offset_s = 0.0, .drift_ppm = 10'000.0};  // 0.12 s in 12 s
  const TeamRun run = RunTwo(traits);
  ASSERT_EQ(run.team.robots.size(), 2u);
  const EpisodeResult& right = run.team.robots[0];
  const EpisodeResult& wrong = run.team.robots[1];
  EXPECT_NEAR(wrong.simulated_s, right.simulated_s, 1e-6);
  ASSERT_FALSE(right.path.empty() || wrong.path.empty() || wrong.plans.empty());
  EXPECT_NEAR(wrong.path.back().time_s, right.path.back().time_s, 1e-6);
  EXPECT_EQ(wrong.path.size(), right.path.size());
  const auto is_of_path = [&](double time_s) {
    return std::any_of(wrong.path.begin(), wrong.path.end(), [time_s](const DrivenPose& at) {
      return std::abs(at.time_s - time_s) < 1e-6;
    });
  };
  for (const IssuedPlan& plan : wrong.plans) EXPECT_TRUE(is_of_path(plan.time_s)) << plan.time_s;
}

TEST(EpisodeOutages, ASlowRobotFallsBehindItsPlans) {
  FakeService service("robot-1");
  service.server().set_script([](const client::PlanQuery& query) {
    const Pose2 start = query.request.start.value();
    Plan plan;
    plan.id = 1;
    plan.trajectory.waypoints = {
        {start, 0.0, 0.0}, {{start.x_m - 1.0, start.y_m, 0.0}, 1.0, 0.0}, {start, 2.0, 0.0}};
    plan.trajectory.length_m = 2.0;
    plan.trajectory.duration_s = 2.0;
    return plan;
  });
  EpisodeOptions options;
  options.mission = "study";
  options.create = MissionOptions{};
  options.duration_s = 12.0;
  options.traits.top_speed_mps = 0.25;
  int ticks = 0;
  options.on_time = [&](double time_s) {
    EXPECT_NEAR(time_s, kTick_s * ticks, 1e-6);
    ++ticks;
  };
  std::vector<EndedLeg> legs;
  options.on_leg = [&](const EndedLeg& leg) { legs.push_back(leg); };
  const auto result = RunEpisode(service, SmallWorld(), options);
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_NEAR(result->distance_m, 0.25 * 11.3, 0.4);
  ASSERT_GE(legs.size(), 1u);
  EXPECT_EQ(legs[0].outcome, ProgressOutcome::kReached);
  EXPECT_GT(legs[0].time_s, 8.0);
  EXPECT_EQ(legs[0].nearest_m, std::numeric_limits<double>::infinity());
  EXPECT_EQ(legs.size(), result->legs_ended.size());
}

TEST(EpisodeOutages, OutagesThatOverlapAreRefused) {
  FakeService service("robot-1");
  EpisodeOptions options;
  options.mission = "study";
  options.traits.outages = {{OutageKind::kSilent, 4.0}, {OutageKind::kLeaves, 5.0}};
  EXPECT_TRUE(absl::IsInvalidArgument(RunEpisode(service, SmallWorld(), options).status()));
}

}  // namespace episode_outages_test
}  // namespace plumescout::lab
