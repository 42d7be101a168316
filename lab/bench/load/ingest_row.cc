// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/status_macros.h"
#include "lab/bench/load/load_team.h"
#include "lab/bench/load/load_timings.h"
#include "lab/bench/load/rows.h"
#include "lab/bench/load/server_process.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr int kMissions = 8;
constexpr int kRobotsPerMission = 4;
constexpr double kCores = 0.5;
constexpr absl::Duration kDrain = absl::Seconds(5);

std::string MissionName(int i) { return absl::StrCat("ingest-", i + 1); }

}  // namespace

absl::StatusOr<std::vector<Bar>> IngestRow(const RowSettings& settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server, ServerProcess::Start({settings.server_program}));
  const auto admin = client::MakeGrpcPlannerClient({.target = server->target()});
  const Grid<std::uint8_t> walls = MakeBuilding(kRowWidth, kRowHeight, settings.seed);
  std::vector<Team> teams;
  for (int i = 0; i < kMissions; ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(admin->CreateMission(MissionName(i), MissionOptions{}));
    const TeamOptions options{.mission = MissionName(i),
                              .robots = kRobotsPerMission,
                              .plan_period = absl::ZeroDuration()};
    PLUMESCOUT_ASSIGN_OR_RETURN(Team team, StartTeam(server->target(), walls, options,
                                                     settings.seed + static_cast<unsigned>(i)));
    teams.push_back(std::move(team));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const ProcessUsage before, server->Usage());
  const absl::Time began = absl::Now();
  absl::SleepFor(settings.time);
  PLUMESCOUT_ASSIGN_OR_RETURN(const ProcessUsage after, server->Usage());
  const double wall_s = absl::ToDoubleSeconds(absl::Now() - began);
  double lost = 0.0;
  double not_counted = 0.0;  // acknowledged, but no event of the mission
  double acknowledged = 0.0;
  for (int i = 0; i < kMissions; ++i) {
    const TeamFigures figures = Stop(teams[static_cast<std::size_t>(i)], kDrain);
    PLUMESCOUT_ASSIGN_OR_RETURN(const LoadTimings mission,
                                AskLoadTimings(server->target(), MissionName(i)));
    lost += figures.lost;
    acknowledged += figures.acknowledged;
    const double events = figures.acknowledged + kRobotsPerMission;
    if (static_cast<double>(mission.revision) < events) {
      not_counted += events - static_cast<double>(mission.revision);
    }
  }
  return std::vector<Bar>{
      {"ingest_cpu_cores", (after.cpu_s - before.cpu_s) / wall_s, kCores},
      {"ingest_lost", lost, 0.0},
      {"ingest_not_in_revision", not_counted, 0.0},
      {"ingest_acknowledged", acknowledged},
      {"ingest_peak_rss_mb", after.peak_rss_mb},
  };
}

}  // namespace plumescout::lab
