// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/load/load_team.h"
#include "lab/bench/load/rows.h"
#include "lab/bench/load/server_process.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "watched";
constexpr int kWatchers = 300;
constexpr char kPeriod[] = "maps.publish_period_s=0.5";  // 2 Hz
constexpr double kCores = 1.0;
constexpr double kSlower = 1.5;
constexpr absl::Duration kPlanPeriod = absl::Milliseconds(200);
constexpr absl::Duration kDrain = absl::Seconds(5);
constexpr absl::Duration kFirstFrames = absl::Seconds(20);

}  // namespace

absl::StatusOr<std::vector<Bar>> WatcherRow(const RowSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server,
                              ServerProcess::Start({settings.server_program, {kPeriod}}));
  const auto admin = client::MakeGrpcPlannerClient({.target = server->target()});
  PLUMESCOUT_RETURN_IF_ERROR(admin->CreateMission(kMission, MissionOptions{}));
  const Grid<std::uint8_t> walls = MakeBuilding(kRowWidth, kRowHeight, settings.seed);
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const Team team, StartTeam(server->target(), walls,
                                 {.mission = kMission, .plan_period = kPlanPeriod}, settings.seed));
  absl::SleepFor(settings.time);
  const TeamFigures alone = Take(team);

  PLUMESCOUT_ASSIGN_OR_RETURN(
      const Bystander::Watch watch,
      settings.bystander->BeginWatch(server->target(), kMission, kWatchers, kFirstFrames));
  Take(team);  // what was planned while they came
  PLUMESCOUT_ASSIGN_OR_RETURN(const ProcessUsage before, server->Usage());
  const absl::Time began = absl::Now();
  absl::SleepFor(settings.time);
  PLUMESCOUT_ASSIGN_OR_RETURN(const ProcessUsage after, server->Usage());
  const double wall_s = absl::ToDoubleSeconds(absl::Now() - began);
  const TeamFigures beside = Take(team);
  PLUMESCOUT_ASSIGN_OR_RETURN(const Bystander::Watched watched, settings.bystander->EndWatch());
  Stop(team, kDrain);
  return std::vector<Bar>{
      {"watchers_cpu_cores", (after.cpu_s - before.cpu_s) / wall_s, kCores},
      {"watchers_sent_away", static_cast<double>(watched.sent_away + watch.without_frame), 0.0},
      {"watchers_frames_per_watcher", watched.frames / kWatchers},
      {"watchers_plan_p99_alone_ms", alone.PlanP99_ms()},
      {"watchers_plan_p99_ms", beside.PlanP99_ms()},
      {"watchers_plan_p99_ratio", beside.PlanP99_ms() / alone.PlanP99_ms(), kSlower},
      {"watchers_plan_failures", beside.plan_failures, 0.0},
      {"watchers_peak_rss_mb", after.peak_rss_mb},
  };
}

}  // namespace plumescout::lab
