// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/team_row.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/bench/load/load_team.h"
#include "lab/bench/load/load_timings.h"
#include "lab/bench/load/load_watcher.h"
#include "lab/bench/load/server_process.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "load";
constexpr int kBuildingWidth = 300;  // cells of 0.1 m
constexpr int kBuildingHeight = 200;
constexpr absl::Duration kDrain = absl::Seconds(10);
constexpr double kTail = 0.99;

// From taking an observation until the watcher has a map that knows it. On the watcher's thread.
class MapDelay {
 public:
  explicit MapDelay(const Team& team) : team_(team) {}

  void Note(const RobotId& robot, std::int64_t applied_sequence, absl::Time arrival) {
    const auto found = team_.find(robot);
    if (found == team_.end()) return;
    std::int64_t& known = known_[robot];
    for (; known < applied_sequence; ++known) {
      const auto taken_at = found->second->TakenAt(known + 1);
      if (taken_at) ages_ms_.push_back(absl::ToDoubleMilliseconds(arrival - *taken_at));
    }
  }
  const std::vector<double>& ages_ms() const { return ages_ms_; }

 private:
  const Team& team_;
  std::map<RobotId, std::int64_t> known_;
  std::vector<double> ages_ms_;
};

void SetTeamFigures(const TeamFigures& team, BenchSummary& summary) {
  summary.Set("plans", static_cast<double>(team.plan_wall_ms.size()));
  summary.Set("plan_failures", team.plan_failures);
  summary.Set("plan_rpc_wall_ms_p50", team.PlanP50_ms());
  summary.Set("plan_rpc_wall_ms_p99", team.PlanP99_ms());
  summary.Set("acknowledged", team.acknowledged);
  summary.Set("lost", team.lost);
}

absl::Status SetGasFigures(const std::string& target, BenchSummary& summary) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const LoadTimings timings, AskLoadTimings(target, kMission));
  summary.Set("gas_update_wall_ms_p50", timings.update_wall_ms_p50);
  summary.Set("gas_update_wall_ms_p99", timings.update_wall_ms_p99);
  summary.Set("belief_staleness_wall_ms_p50", timings.staleness_wall_ms_p50);
  summary.Set("belief_staleness_wall_ms_p99", timings.staleness_wall_ms_p99);
  return absl::OkStatus();
}

}  // namespace

absl::Status RunTeam(const TeamFlags& flags, const std::string& server_program,
                     BenchSummary& summary) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server, ServerProcess::Start({server_program}));
  const auto admin = client::MakeGrpcPlannerClient({.target = server->target()});
  PLUMESCOUT_RETURN_IF_ERROR(admin->CreateMission(kMission, MissionOptions{}));
  const Grid<std::uint8_t> walls = MakeBuilding(kBuildingWidth, kBuildingHeight, summary.seed());
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const Team team,
      StartTeam(server->target(), walls,
                {.mission = kMission, .robots = flags.robots, .scan_hz = flags.scan_hz},
                summary.seed()));
  MapDelay map_delay(team);
  TeamFigures figures;
  {
    const LoadWatcher watcher(
        server->target(), kMission,
        [&map_delay](const RobotId& robot, std::int64_t applied, absl::Time arrival) {
          map_delay.Note(robot, applied, arrival);
        });
    PLUMESCOUT_ASSIGN_OR_RETURN(const ProcessUsage before, server->Usage());
    const absl::Time start = absl::Now();
    absl::SleepFor(absl::Seconds(flags.seconds));
    PLUMESCOUT_ASSIGN_OR_RETURN(const ProcessUsage after, server->Usage());
    const double wall_s = absl::ToDoubleSeconds(absl::Now() - start);
    summary.Set("robots", flags.robots);
    summary.Set("scan_hz", flags.scan_hz);
    summary.Set("cpu_cores_used", (after.cpu_s - before.cpu_s) / wall_s);
    summary.Set("rss_mb", after.peak_rss_mb);
    PLUMESCOUT_RETURN_IF_ERROR(SetGasFigures(server->target(), summary));
    figures = Stop(team, kDrain);
  }
  summary.Set("map_delay_wall_ms_p99", Quantile(map_delay.ages_ms(), kTail));
  SetTeamFigures(figures, summary);
  return absl::OkStatus();
}

}  // namespace plumescout::lab
