// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Robots that share a mission, in lockstep: the same bytes however often and by whichever way, and
// once more from the record.
#include <gtest/gtest.h>

#include <vector>

#include "core/belief/belief.h"
#include "core/mission/mission.h"
#include "lab/local/local_planner_client.h"
#include "tests/e2e/hall_run.h"

namespace plumescout::lab {
namespace team_test {

constexpr double kDuration_s = 20.0;

struct TeamRun {
  TeamResult team;
  MapSnapshot map;
};

EpisodeOptions WestRobot() {
  EpisodeOptions options = HallOptions();
  options.robot = "west";
  options.duration_s = kDuration_s;
  options.metrics_period_s = 5.0;
  return options;
}

std::vector<Teammate> Others(int robots) {
  const std::vector<Teammate> all = {{"east", {5.2, 3.6, M_PI}, 2}, {"south", {5.4, 0.8, M_PI}, 3}};
  return {all.begin(), all.begin() + (robots - 1)};
}

TeamRun RunTeam(client::PlannerClient& planner, int robots) {
  TeamRun run;
  auto team = RunTeamEpisode(planner, GasHall(), WestRobot(), Others(robots));
  EXPECT_TRUE(team.ok()) << team.status();
  if (!team.ok()) return run;
  run.team = *std::move(team);
  auto map = planner.GetMap(kHallMission);
  EXPECT_TRUE(map.ok()) << map.status();
  if (map.ok()) run.map = *std::move(map);
  return run;
}

TeamRun RunInProcess(int robots) {
  LocalPlannerClient local;
  const auto planner = WithTap(local, AsOnTheWire);
  return RunTeam(*planner, robots);
}

void ExpectSame(const TeamRun& a, const TeamRun& b) {
  ASSERT_EQ(a.team.robots.size(), b.team.robots.size());
  for (std::size_t r = 0; r < a.team.robots.size(); ++r) {
    const EpisodeResult& one = a.team.robots[r];
    const EpisodeResult& other = b.team.robots[r];
    ASSERT_EQ(one.path.size(), other.path.size()) << r;
    for (std::size_t i = 0; i < one.path.size(); ++i) {
      ASSERT_EQ(one.path[i].pose, other.path[i].pose) << r << ", " << i;
    }
    EXPECT_TRUE(ComparablePlans(one) == ComparablePlans(other)) << r;
  }
  ASSERT_EQ(a.team.samples.size(), b.team.samples.size());
  for (std::size_t i = 0; i < a.team.samples.size(); ++i) {
    EXPECT_EQ(a.team.samples[i].time_s, b.team.samples[i].time_s);
    EXPECT_EQ(a.team.samples[i].metrics.completeness, b.team.samples[i].metrics.completeness);
    EXPECT_EQ(a.team.samples[i].metrics.rmse_ppm, b.team.samples[i].metrics.rmse_ppm);
  }
  EXPECT_EQ(a.team.closest_m, b.team.closest_m);
  EXPECT_TRUE(SameMap(a.map, b.map));
}

TEST(TeamTest, AMissionOfThreeIsWorthComparing) {
  const TeamRun run = RunInProcess(3);
  ASSERT_EQ(run.team.robots.size(), 3u);
  for (const EpisodeResult& robot : run.team.robots) {
    EXPECT_EQ(robot.readings_applied, robot.readings_sent);
    EXPECT_GT(robot.distance_m, 2.0);
    EXPECT_GE(robot.plans.size(), 1u);
    EXPECT_EQ(robot.collisions, 0);
    EXPECT_NEAR(robot.simulated_s, kDuration_s, 0.2);
  }
  EXPECT_EQ(run.map.robots.size(), 3u);
  ASSERT_GE(run.team.samples.size(), 5u);
  EXPECT_GT(run.team.samples.back().metrics.completeness,
            run.team.samples.front().metrics.completeness);
  EXPECT_GT(run.team.closest_m, 0.0);
  EXPECT_LT(run.team.closest_m, 4.4) << "their starts";
}

TEST(TeamTest, TheSameTeamComesToTheSameBytes) { ExpectSame(RunInProcess(3), RunInProcess(3)); }

TEST(TeamTest, OverGrpcATeamComesToTheBytesOfOneProcess) {
  const auto server = StartServer();
  const auto planner = ClientOf(*server);
  ExpectSame(RunTeam(*planner, 2), RunInProcess(2));
}

TEST(TeamTest, SeveralRobotsSeeMoreInTheSameTime) {
  const auto completeness = [](int robots) {
    return RunInProcess(robots).team.samples[1].metrics.completeness;  // after 5 s
  };
  EXPECT_GT(completeness(3), completeness(1));
}

// Not a wall where another robot once stood: what is occupied in the map is so in truth.
TEST(TeamTest, RobotsAreNoWallsInTheMap) {
  const TeamRun run = RunInProcess(3);
  const Grid<CellState>& truth = GasHall().occupancy();
  int phantoms = 0;
  for (std::size_t i = 0; i < run.map.occupancy.size(); ++i) {
    const GridGeometry& geometry = run.map.occupancy.geometry();
    if (run.map.occupancy[i] != CellState::kOccupied) continue;
    const Point2 center = geometry.Center(geometry.CellAtIndex(i));
    bool near_wall = false;  // noise of beams blurs walls by a cell
    for (const double dx_m : {-0.1, 0.0, 0.1}) {
      for (const double dy_m : {-0.1, 0.0, 0.1}) {
        const Cell cell = truth.geometry().CellAt({center.x_m + dx_m, center.y_m + dy_m});
        near_wall = near_wall || truth.At(cell, CellState::kOccupied) == CellState::kOccupied;
      }
    }
    phantoms += near_wall ? 0 : 1;
  }
  EXPECT_EQ(phantoms, 0);
}

TEST(TeamTest, ItsEventsReplayToTheSameMap) {
  for (const int robots : {1, 2}) {
    std::vector<Event> events;
    LocalOptions options;
    options.on_event = [&](const Event& event) { events.push_back(event); };
    LocalPlannerClient planner(options);
    const TeamRun run = RunTeam(planner, robots);
    auto mission = Mission::Create(*WestRobot().create);
    ASSERT_TRUE(mission.ok()) << mission.status();
    for (const Event& event : events) {
      const auto applied = (*mission)->Apply(event.body);
      ASSERT_TRUE(applied.ok()) << applied.status();
      ASSERT_EQ(applied->revision, event.number);
    }
    EXPECT_TRUE(SameMap(MakeMapSnapshot(*(*mission)->Snapshot()), run.map)) << robots;
  }
}

TEST(TeamTest, OverGrpcRobotsComeBackFromOutages) {
  const auto server = StartServer();
  const auto planner = ClientOf(*server);
  EpisodeOptions options = WestRobot();
  options.duration_s = 10.0;
  options.watch = false;
  std::vector<Teammate> others = Others(3);
  others[0].traits.outages = {{OutageKind::kLinkLost, 3.0, 3.0}};
  others[1].traits.outages = {{OutageKind::kSilent, 3.0, 2.0}, {OutageKind::kLeaves, 7.0, 1.0}};
  const auto team = RunTeamEpisode(*planner, GasHall(), options, others);
  ASSERT_TRUE(team.ok()) << team.status();
  for (const EpisodeResult& robot : team->robots) {
    EXPECT_FALSE(robot.absent);
    EXPECT_NEAR(robot.simulated_s, options.duration_s, 0.2);
    EXPECT_EQ(robot.readings_applied, robot.readings_sent);
  }
  const EpisodeResult& east = team->robots[1];
  EXPECT_NEAR(static_cast<double>(east.readings_sent), 12.0 * options.duration_s, 4.0)
      << "without a link it senses on";
  EXPECT_LT(team->robots[2].readings_sent, east.readings_sent - 25) << "it was off";
}

TEST(TeamTest, AnErrorOfOneEndsTheEpisodeForAll) {
  LocalPlannerClient planner;
  EpisodeOptions options = WestRobot();
  int west_plans = 0;
  options.on_plan = [&](const IssuedPlan& issued) {
    west_plans += issued.plan.robot == "west" ? 1 : 0;
    if (west_plans != 1) return;
    EXPECT_TRUE(planner.RegisterRobot(kHallMission, "east", 0.2, true).ok());  // takes its lease
  };
  const auto team = RunTeamEpisode(planner, GasHall(), options, Others(2));
  EXPECT_NE(team.status().message().find("LEASE_SUPERSEDED"), absl::string_view::npos)
      << team.status();
  EXPECT_LE(west_plans, 2);
}

}  // namespace team_test
}  // namespace plumescout::lab
