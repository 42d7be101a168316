// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/load/load_team.h"
#include "lab/bench/load/rows.h"
#include "lab/bench/load/server_process.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "plans";
constexpr int kRobots = 8;
constexpr double kDefaultP99_ms = 60.0;
constexpr double kXitGffP99_ms = 20.0;
constexpr absl::Duration kDrain = absl::Seconds(5);

absl::Status Measure(const RowSettings& settings, const std::string& name,
                     const MissionOptions& options, double p99_limit_ms, std::vector<Bar>& bars) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server, ServerProcess::Start({settings.server_program}));
  const auto admin = client::MakeGrpcPlannerClient({.target = server->target()});
  PLUMESCOUT_RETURN_IF_ERROR(admin->CreateMission(kMission, options));
  const Grid<std::uint8_t> walls = MakeBuilding(kRowWidth, kRowHeight, settings.seed);
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const Team team,
      StartTeam(server->target(), walls, {.mission = kMission, .robots = kRobots}, settings.seed));
  PLUMESCOUT_ASSIGN_OR_RETURN(const ProcessUsage before, server->Usage());
  const absl::Time began = absl::Now();
  absl::SleepFor(settings.time);
  PLUMESCOUT_ASSIGN_OR_RETURN(const ProcessUsage after, server->Usage());
  const double wall_s = absl::ToDoubleSeconds(absl::Now() - began);
  const TeamFigures figures = Stop(team, kDrain);
  bars.push_back({absl::StrCat(name, "_plan_p50_ms"), figures.PlanP50_ms()});
  bars.push_back({absl::StrCat(name, "_plan_p99_ms"), figures.PlanP99_ms(), p99_limit_ms});
  bars.push_back({absl::StrCat(name, "_plan_failures"), figures.plan_failures, 0.0});
  bars.push_back({absl::StrCat(name, "_lost"), figures.lost, 0.0});
  bars.push_back({absl::StrCat(name, "_cpu_cores"), (after.cpu_s - before.cpu_s) / wall_s});
  bars.push_back({absl::StrCat(name, "_peak_rss_mb"), after.peak_rss_mb});
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::vector<Bar>> PlanRow(const RowSettings& settings) {
  std::vector<Bar> bars;
  PLUMESCOUT_RETURN_IF_ERROR(
      Measure(settings, "plans_default", MissionOptions{}, kDefaultP99_ms, bars));
  MissionOptions options;
  options.planning.strategy = "xit_gff";
  PLUMESCOUT_RETURN_IF_ERROR(Measure(settings, "plans_xit_gff", options, kXitGffP99_ms, bars));
  return bars;
}

}  // namespace plumescout::lab
