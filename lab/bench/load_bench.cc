// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Loads a server over the loopback interface as a team of robots does, in real time, with an
// operator watching the map.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "CLI/App.hpp"
#include "CLI/Config.hpp"
#include "CLI/Formatter.hpp"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/bench/bench_summary.h"
#include "lab/bench/load_robot.h"
#include "lab/bench/load_timings.h"
#include "lab/bench/load_watcher.h"
#include "lab/bench/server_process.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "load";
constexpr int kBuildingWidth = 300;  // cells of 0.1 m
constexpr int kBuildingHeight = 200;
constexpr absl::Duration kDrain = absl::Seconds(10);
constexpr double kMedian = 0.5;
constexpr double kTail = 0.99;

struct LoadFlags {
  int robots = 4;
  double seconds = 20.0;
  double scan_hz = 10.0;
  std::string server_program = SiblingProgram("plumescout-server");
};

using Team = std::map<RobotId, std::unique_ptr<LoadRobot>>;

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

absl::StatusOr<Team> StartTeam(const LoadFlags& flags, const std::string& target,
                               const Grid<std::uint8_t>& walls, std::uint64_t seed) {
  const std::vector<Pose2> starts = FreePoses(walls, flags.robots, seed);
  Team team;
  for (int i = 0; i < flags.robots; ++i) {
    LoadRobotOptions options;
    options.participation.mission = kMission;
    options.participation.robot = absl::StrCat("robot-", i + 1);
    options.start = starts[static_cast<std::size_t>(i)];
    options.scan_hz = flags.scan_hz;
    options.plan_offset = options.plan_period * i / flags.robots;
    PLUMESCOUT_ASSIGN_OR_RETURN(
        team[options.participation.robot],
        LoadRobot::Start(client::MakeGrpcPlannerClient({.target = target}), walls, options));
  }
  return team;
}

void SetTeamFigures(const std::vector<LoadRobotFigures>& team, BenchSummary& summary) {
  std::vector<double> plan_wall_ms;
  double acknowledged = 0.0;
  double lost = 0.0;
  double plan_failures = 0.0;
  for (const LoadRobotFigures& robot : team) {
    plan_wall_ms.insert(plan_wall_ms.end(), robot.plan_wall_ms.begin(), robot.plan_wall_ms.end());
    const client::IngestStatistics& ingest = robot.ingest;
    acknowledged += static_cast<double>(ingest.applied_sequence);
    lost += static_cast<double>(ingest.last_sequence - ingest.applied_sequence + ingest.lost);
    plan_failures += static_cast<double>(robot.plan_failures);
  }
  summary.Set("plans", static_cast<double>(plan_wall_ms.size()));
  summary.Set("plan_failures", plan_failures);
  summary.Set("plan_rpc_wall_ms_p50", Quantile(plan_wall_ms, kMedian));
  summary.Set("plan_rpc_wall_ms_p99", Quantile(plan_wall_ms, kTail));
  summary.Set("acknowledged", acknowledged);
  summary.Set("lost", lost);
}

absl::Status SetGasFigures(const std::string& target, BenchSummary& summary) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const LoadTimings timings, AskLoadTimings(target, kMission));
  summary.Set("gas_update_wall_ms_p50", timings.update_wall_ms_p50);
  summary.Set("gas_update_wall_ms_p99", timings.update_wall_ms_p99);
  summary.Set("belief_staleness_wall_ms_p50", timings.staleness_wall_ms_p50);
  summary.Set("belief_staleness_wall_ms_p99", timings.staleness_wall_ms_p99);
  return absl::OkStatus();
}

absl::Status RunLoad(const LoadFlags& flags, BenchSummary& summary) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto server, ServerProcess::Start(flags.server_program));
  const auto admin = client::MakeGrpcPlannerClient({.target = server->target()});
  PLUMESCOUT_RETURN_IF_ERROR(admin->CreateMission(kMission, MissionOptions{}));
  const Grid<std::uint8_t> walls = MakeBuilding(kBuildingWidth, kBuildingHeight, summary.seed());
  PLUMESCOUT_ASSIGN_OR_RETURN(Team team, StartTeam(flags, server->target(), walls, summary.seed()));
  MapDelay map_delay(team);
  std::vector<LoadRobotFigures> figures;
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
    for (const auto& [id, robot] : team) figures.push_back(robot->Stop(kDrain));
  }
  summary.Set("map_delay_wall_ms_p99", Quantile(map_delay.ages_ms(), kTail));
  SetTeamFigures(figures, summary);
  return absl::OkStatus();
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  plumescout::lab::LoadFlags flags;
  CLI::App app("Loads a server over loopback: robots that scan, smell and plan in real time.");
  app.add_option("--robots", flags.robots, "how many")->check(CLI::Range(1, 32));
  app.add_option("--seconds", flags.seconds, "how long")->check(CLI::Range(1.0, 86'400.0));
  app.add_option("--scan-hz", flags.scan_hz, "scans a second")->check(CLI::Range(0.1, 100.0));
  app.add_option("--server-program", flags.server_program, "plumescout-server to load");
  return plumescout::lab::RunBench(app, argc, argv,
                                   [&flags](plumescout::lab::BenchSummary& summary) {
                                     return plumescout::lab::RunLoad(flags, summary);
                                   });
}
