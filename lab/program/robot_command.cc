// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/robot_command.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "client/grpc_viewer_client.h"
#include "core/belief/gas_query.h"
#include "core/plan/strategy.h"
#include "core/types/status_macros.h"
#include "lab/formats/scene_folder.h"
#include "lab/local/local_planner_client.h"
#include "lab/program/objective_survey.h"
#include "lab/program/progress_line.h"
#include "lab/program/recording.h"
#include "lab/program/robot_arguments.h"
#include "lab/program/run_folder.h"
#include "lab/report/plan_names.h"
#include "lab/sim/episode.h"
#include "lab/sim/scene_world.h"
#include "ompl_planners/ompl_planner.h"

namespace plumescout::lab {
namespace {

// Highest estimated concentration, ppm.
double HighestMean_ppm(const MapSnapshot& map) {
  double highest_ppm = 0.0;
  for (const float mean_ppm : map.gas_mean_ppm.values()) {
    if (std::isfinite(mean_ppm)) highest_ppm = std::max(highest_ppm, double{mean_ppm});
  }
  return highest_ppm;
}

// Keeps the user informed and the last map at hand while an episode runs.
class EpisodeDisplay {
 public:
  EpisodeDisplay(double duration_s, absl::Time start) : duration_s_(duration_s), start_(start) {}

  void OnPlan(const IssuedPlan& plan) {
    const double cpu_ms = plan.plan.cpu_s * 1e3;
    plan_ms_ = cpu_ms > 0.0 ? cpu_ms : absl::ToDoubleMilliseconds(plan.rpc_wall);
  }

  void OnSample(const MetricSample& sample, const MapSnapshot& map) {
    last_map_ = map;
    line_.Show(absl::StrFormat(
        "%s %5.0f s simulated, %4.1f s wall | %-11s | map %5.1f %% | gas up to %5.1f ppm, RMSE "
        "%5.2f ppm | plan %.1f ms",
        ProgressBar(sample.time_s / duration_s_), sample.time_s,
        absl::ToDoubleSeconds(absl::Now() - start_), NameOf(map.phase),
        100.0 * sample.metrics.completeness, HighestMean_ppm(map), sample.metrics.rmse_ppm,
        plan_ms_));
  }

  ProgressLine& line() { return line_; }
  const MapSnapshot& last_map() const { return last_map_; }

 private:
  const double duration_s_;
  const absl::Time start_;
  ProgressLine line_{absl::Seconds(2)};
  double plan_ms_ = 0.0;
  MapSnapshot last_map_;
};

// Kills the server once, as the arguments say.
class Crash {
 public:
  explicit Crash(const RobotArguments& arguments) : arguments_(arguments) {}

  void OnTime(double time_s) {
    if (happened_s_ || !arguments_.crash_at_s || time_s < *arguments_.crash_at_s) return;
    happened_s_ = time_s;
    const int code = std::system(arguments_.crash_command.c_str());
    if (code != 0) {
      status_ = absl::UnknownError(
          absl::StrCat("--crash-command ", arguments_.crash_command, " ended with ", code));
    }
  }

  std::optional<double> happened_s() const { return happened_s_; }
  const absl::Status& status() const { return status_; }

 private:
  const RobotArguments& arguments_;
  std::optional<double> happened_s_;
  absl::Status status_;
};

// Sums over the robots of a team.
struct TeamSums {
  int plans = 0;
  double distance_m = 0.0;
  std::int64_t sent = 0;
  std::int64_t applied = 0;
};

TeamSums SumsOf(const TeamResult& team) {
  TeamSums sums;
  for (const EpisodeResult& robot : team.robots) {
    sums.plans += static_cast<int>(robot.plans.size());
    sums.distance_m += robot.distance_m;
    sums.sent += robot.readings_sent;
    sums.applied += robot.readings_applied;
  }
  return sums;
}

std::string Verdict(const TeamResult& team, double wall_s) {
  const MapMetrics& metrics = team.samples.back().metrics;
  const TeamSums sums = SumsOf(team);
  std::string verdict = absl::StrFormat(
      "%s after %.0f s simulated (%.1f s wall): map %.1f %% complete, RMSE %.2f ppm (clean air: "
      "%.2f), %d plans, %.0f m driven, %d of %d readings applied",
      IsComplete(team) ? "Mission complete" : "Time is up", team.samples.back().time_s, wall_s,
      100.0 * metrics.completeness, metrics.rmse_ppm, metrics.rmse_zero_ppm, sums.plans,
      sums.distance_m, sums.applied, sums.sent);
  if (team.robots.size() > 1) {
    absl::StrAppend(&verdict, absl::StrFormat(", %d robots never nearer than %.2f m, %d contacts",
                                              team.robots.size(), team.closest_m, team.contacts));
  }
  return verdict;
}

// What came of an episode, and of what its mission was for.
struct Ended {
  TeamResult team;
  std::optional<ObjectiveOutcome> objective;
};

// `map`: where the last map of the episode is, once it has ended.
absl::StatusOr<Ended> RunByServer(const RobotArguments& arguments, const SceneWorld& world,
                                  PlannedEpisode planned, const MapSnapshot& map) {
  EpisodeOptions& options = planned.options;
  client::GrpcClientOptions link;
  link.target = arguments.server;
  // A server looks at plans by its own clock, and lockstep is to be repeatable.
  options.watch = options.realtime;
  PLUMESCOUT_ASSIGN_OR_RETURN(TeamResult team, RunTeamEpisode(*client::MakeGrpcPlannerClient(link),
                                                              world, options, planned.teammates));
  Ended ended{std::move(team), std::nullopt};
  if (!map.objective) return ended;
  const auto viewer = client::MakeGrpcViewerClient(link);
  // Somebody else may have made the mission.
  PLUMESCOUT_ASSIGN_OR_RETURN(const client::MissionDetails mission,
                              viewer->GetMission(options.mission));
  const AskGas ask =
      [&](const std::vector<Point2>& places) -> absl::StatusOr<std::vector<GasAtPlace>> {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        client::GasAnswer answer,
        viewer->QueryGas(options.mission, {.points = places, .with_verdicts = true}));
    return std::move(answer.gas);
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(
      ended.objective,
      SurveyObjective(mission.options.objective, map, options.simulated.start_time_ns, ask));
  return ended;
}

// In this process, with the mission's events recorded.
absl::StatusOr<Ended> RunHere(const RobotArguments& arguments, const SceneWorld& world,
                              PlannedEpisode planned, const MapSnapshot& map) {
  EpisodeOptions& options = planned.options;
  PLUMESCOUT_RETURN_IF_ERROR(ApplyStrategyRow(options.create->planning));  // as servers do
  PLUMESCOUT_ASSIGN_OR_RETURN(Recorder recorder,
                              Recorder::Create(arguments.record, *options.create));
  LocalOptions local;
  local.path_planners = MakeOmplPlanner;
  local.on_event = [&recorder](const Event& event) { recorder.Record(event); };
  if (options.realtime) {
    local.mission_clock_ns = [] { return absl::ToUnixNanos(absl::Now()); };
  } else if (options.world_time_ns) {
    local.mission_clock_ns = [time_ns = options.world_time_ns] { return time_ns->load(); };
  }
  LocalPlannerClient planner(local);
  PLUMESCOUT_ASSIGN_OR_RETURN(TeamResult team,
                              RunTeamEpisode(planner, world, options, planned.teammates));
  PLUMESCOUT_RETURN_IF_ERROR(recorder.status());
  Ended ended{std::move(team), std::nullopt};
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::shared_ptr<const Belief> belief,
                              planner.GetBelief(options.mission));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      ended.objective,
      SurveyObjective(belief->options->objective, map, options.simulated.start_time_ns,
                      [&](const std::vector<Point2>& places) {
                        return QueryGas(*belief, places, 0, /*with_verdicts=*/true);
                      }));
  return ended;
}

absl::Status DriveRobots(const RobotArguments& arguments) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(arguments.world));
  PLUMESCOUT_ASSIGN_OR_RETURN(Scene scene, ReadScene(arguments.scene));
  const SceneWorld world(std::move(scene), arguments.world);
  PLUMESCOUT_ASSIGN_OR_RETURN(PlannedEpisode planned, PlanEpisode(arguments, world));
  const absl::Time start = absl::Now();
  EpisodeDisplay display(arguments.duration_s, start);
  Crash crash(arguments);
  planned.options.on_plan = [&](const IssuedPlan& plan) { display.OnPlan(plan); };
  planned.options.on_sample = [&](const MetricSample& sample, const MapSnapshot& map) {
    display.OnSample(sample, map);
    crash.OnTime(sample.time_s);
  };
  const auto run_episode = arguments.record.empty() ? RunByServer : RunHere;
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const Ended ended, run_episode(arguments, world, std::move(planned), display.last_map()));
  const double wall_s = absl::ToDoubleSeconds(absl::Now() - start);
  display.line().Finish(Verdict(ended.team, wall_s));
  PLUMESCOUT_RETURN_IF_ERROR(crash.status());
  const Run run{.world = world,
                .team = ended.team,
                .final_map = display.last_map(),
                .strategy = arguments.strategy,
                .seed = arguments.seed,
                .wall_s = wall_s,
                .server_killed_s = crash.happened_s(),
                .objective = ended.objective,
                .look = {.lidar_range_m = arguments.lidar.max_range_m}};
  PLUMESCOUT_RETURN_IF_ERROR(WriteRunFolder(run, arguments.out));
  std::cout << arguments.out << "/report.html\n";
  return absl::OkStatus();
}

}  // namespace

void AddRobotCommand(CLI::App& app, absl::Status& status) {
  CLI::App* robot = app.add_subcommand(
      "robot",
      "Drive simulated robots through a scene, planned by a server over gRPC or in this process");
  const auto arguments = std::make_shared<RobotArguments>();
  AddRobotOptions(*robot, *arguments);
  robot->callback([arguments, &status] { status = DriveRobots(*arguments); });
}

}  // namespace plumescout::lab
