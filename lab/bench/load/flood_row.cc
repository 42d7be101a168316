// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/load/flood.h"
#include "lab/bench/load/known_map.h"
#include "lab/bench/load/load_team.h"
#include "lab/bench/load/rows.h"
#include "lab/bench/load/server_process.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "flooded";
constexpr int kHonest = 7;
constexpr double kTimesItsQuota = 100.0;
constexpr double kSlower = 1.2;
constexpr absl::Duration kPlanPeriod = absl::Milliseconds(500);
constexpr absl::Duration kDrain = absl::Seconds(10);

}  // namespace

absl::StatusOr<std::vector<Bar>> FloodRow(const RowSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server, ServerProcess::Start({settings.server_program}));
  const auto admin = client::MakeGrpcPlannerClient({.target = server->target()});
  MissionOptions options;
  options.max_robot_speed_mps = 0.0;  // readings come from all over the place
  PLUMESCOUT_RETURN_IF_ERROR(admin->CreateMission(kMission, options));
  const Grid<std::uint8_t> walls = MakeBuilding(kRowWidth, kRowHeight, settings.seed);
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const Team team,
      StartTeam(server->target(), walls,
                {.mission = kMission, .robots = kHonest, .plan_period = kPlanPeriod},
                settings.seed));
  const Pose2 pose = FreePoses(walls, kHonest + 1, settings.seed).back();
  PLUMESCOUT_ASSIGN_OR_RETURN(client::RobotSession session,
                              PlaceRobot(*admin, kMission, "flood", pose));
  session.ingest.applied_sequence = 1;
  absl::SleepFor(settings.time);
  const TeamFigures before = Take(team);

  const Quota quota = AskQuota(server->target());
  PLUMESCOUT_ASSIGN_OR_RETURN(const ProcessUsage usage_before, server->Usage());
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const FloodFigures flooded,
      settings.bystander->RunFlood(server->target(), session,
                                   {.plans_per_s = kTimesItsQuota * quota.plans_per_s,
                                    .readings_per_s = kTimesItsQuota * quota.readings_per_s,
                                    .seed = settings.seed},
                                   settings.time));
  PLUMESCOUT_ASSIGN_OR_RETURN(const ProcessUsage usage, server->Usage());
  const TeamFigures during = Take(team);
  const TeamFigures rest = Stop(team, kDrain);
  return std::vector<Bar>{
      {"flood_plan_p99_before_ms", before.PlanP99_ms()},
      {"flood_plan_p99_ms", during.PlanP99_ms()},
      {"flood_plan_p99_ratio", during.PlanP99_ms() / before.PlanP99_ms(), kSlower},
      {"flood_plan_failures", during.plan_failures, 0.0},
      {"flood_lost", rest.lost, 0.0},
      {"flood_plans_asked", static_cast<double>(flooded.plans_asked)},
      {"flood_plans_made", static_cast<double>(flooded.plans_made)},
      {"flood_cpu_cores",
       (usage.cpu_s - usage_before.cpu_s) / absl::ToDoubleSeconds(settings.time)},
      {"flood_readings_sent", static_cast<double>(flooded.readings_sent)},
      {"flood_readings_taken", static_cast<double>(flooded.readings_taken)},
  };
}

}  // namespace plumescout::lab
