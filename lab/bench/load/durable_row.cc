// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/bench/load/data_folder.h"
#include "lab/bench/load/load_team.h"
#include "lab/bench/load/rows.h"
#include "lab/bench/load/server_process.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "durable";
constexpr int kPlanners = 4;
constexpr int kSenders = 8;
constexpr double kPlanRatio = 1.3;
constexpr double kDurableP99_ms = 50.0;
constexpr double kTail = 0.99;
constexpr absl::Duration kLook = absl::Milliseconds(1);
constexpr absl::Duration kDrain = absl::Seconds(5);

// From the first sight of an observation as applied until it is seen as durable.
class DurableLags {
 public:
  void Look(const Team& team) {
    const absl::Time now = absl::Now();
    for (const auto& [id, robot] : team) {
      const client::IngestStatistics log = robot->ingest_statistics();
      Robot& known = robots_[id];
      if (log.applied_sequence > known.applied) {
        known.applied = log.applied_sequence;
        known.waiting.emplace_back(known.applied, now);
      }
      while (!known.waiting.empty() && known.waiting.front().first <= log.durable_sequence) {
        lags_ms_.push_back(absl::ToDoubleMilliseconds(now - known.waiting.front().second));
        known.waiting.pop_front();
      }
    }
  }
  const std::vector<double>& lags_ms() const { return lags_ms_; }

 private:
  struct Robot {
    std::int64_t applied = 0;
    std::deque<std::pair<std::int64_t, absl::Time>> waiting;  // number, and when it was applied
  };

  std::map<RobotId, Robot> robots_;
  std::vector<double> lags_ms_;
};

absl::StatusOr<TeamFigures> RunPlanners(const RowSettings& settings,
                                        std::vector<std::string> server_settings) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const auto server,
      ServerProcess::Start({settings.server_program, std::move(server_settings)}));
  const auto admin = client::MakeGrpcPlannerClient({.target = server->target()});
  PLUMESCOUT_RETURN_IF_ERROR(admin->CreateMission(kMission, MissionOptions{}));
  const Grid<std::uint8_t> walls = MakeBuilding(kRowWidth, kRowHeight, settings.seed);
  PLUMESCOUT_ASSIGN_OR_RETURN(const Team team,
                              StartTeam(server->target(), walls,
                                        {.mission = kMission, .robots = kPlanners}, settings.seed));
  absl::SleepFor(settings.time);
  return Stop(team, kDrain);
}

absl::StatusOr<std::vector<double>> RunSenders(const RowSettings& settings,
                                               const DataFolder& folder) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server,
                              ServerProcess::Start({settings.server_program, folder.Settings()}));
  const auto admin = client::MakeGrpcPlannerClient({.target = server->target()});
  PLUMESCOUT_RETURN_IF_ERROR(admin->CreateMission("senders", MissionOptions{}));
  const Grid<std::uint8_t> walls = MakeBuilding(kRowWidth, kRowHeight, settings.seed);
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const Team team,
      StartTeam(server->target(), walls,
                {.mission = "senders", .robots = kSenders, .plan_period = absl::ZeroDuration()},
                settings.seed));
  DurableLags lags;
  for (const absl::Time end = absl::Now() + settings.time; absl::Now() < end;) {
    lags.Look(team);
    absl::SleepFor(kLook);
  }
  Stop(team, kDrain);
  return lags.lags_ms();
}

}  // namespace

absl::StatusOr<std::vector<Bar>> DurableRow(const RowSettings& settings) {
  const DataFolder folder;
  PLUMESCOUT_ASSIGN_OR_RETURN(const absl::Duration sync, folder.SyncTime());
  PLUMESCOUT_ASSIGN_OR_RETURN(const TeamFigures without,
                              RunPlanners(settings, {"store.engine=none"}));
  PLUMESCOUT_ASSIGN_OR_RETURN(const TeamFigures with, RunPlanners(settings, folder.Settings()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<double> lags_ms, RunSenders(settings, folder));
  const double sync_ms = absl::ToDoubleMilliseconds(sync);
  return std::vector<Bar>{
      {"durable_sync_ms", sync_ms},
      {"durable_plan_p50_without_ms", without.PlanP50_ms()},
      {"durable_plan_p50_with_ms", with.PlanP50_ms()},
      {"durable_plan_p50_less_a_sync_ratio", (with.PlanP50_ms() - sync_ms) / without.PlanP50_ms(),
       kPlanRatio},
      {"durable_plan_failures", without.plan_failures + with.plan_failures, 0.0},
      {"durable_lag_p50_ms", Quantile(lags_ms, 0.5)},
      {"durable_lag_p99_ms", Quantile(lags_ms, kTail), kDurableP99_ms}};
}

}  // namespace plumescout::lab
