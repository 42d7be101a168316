// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/load_team.h"

#include "absl/strings/str_cat.h"
#include "client/grpc_planner_client.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr double kMedian = 0.5;
constexpr double kTail = 0.99;

void Add(const LoadRobotFigures& robot, TeamFigures& team) {
  team.plan_wall_ms.insert(team.plan_wall_ms.end(), robot.plan_wall_ms.begin(),
                           robot.plan_wall_ms.end());
  const client::IngestStatistics& ingest = robot.ingest;
  team.acknowledged += static_cast<double>(ingest.applied_sequence);
  team.lost += static_cast<double>(ingest.last_sequence - ingest.applied_sequence + ingest.lost);
  team.plan_failures += static_cast<double>(robot.plan_failures);
}

}  // namespace

double TeamFigures::PlanP50_ms() const { return Quantile(plan_wall_ms, kMedian); }
double TeamFigures::PlanP99_ms() const { return Quantile(plan_wall_ms, kTail); }

absl::StatusOr<Team> StartTeam(const std::string& target, const Grid<std::uint8_t>& walls,
                               const TeamOptions& options, std::uint64_t seed) {
  const std::vector<Pose2> starts = FreePoses(walls, options.robots, seed);
  Team team;
  for (int i = 0; i < options.robots; ++i) {
    LoadRobotOptions robot;
    robot.participation.mission = options.mission;
    robot.participation.robot = absl::StrCat("robot-", i + 1);
    robot.start = starts[static_cast<std::size_t>(i)];
    robot.scan_hz = options.scan_hz;
    robot.plan_period = options.plan_period;
    robot.plan_offset = options.plan_period * i / options.robots;
    PLUMESCOUT_ASSIGN_OR_RETURN(
        team[robot.participation.robot],
        LoadRobot::Start(client::MakeGrpcPlannerClient({.target = target}), walls, robot));
  }
  return team;
}

TeamFigures Take(const Team& team) {
  TeamFigures figures;
  for (const auto& [id, robot] : team) Add(robot->Take(), figures);
  return figures;
}

TeamFigures Stop(const Team& team, absl::Duration drain) {
  TeamFigures figures;
  for (const auto& [id, robot] : team) Add(robot->Stop(drain), figures);
  return figures;
}

}  // namespace plumescout::lab
