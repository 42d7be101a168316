// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/robot_command.h"

#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "core/plan/strategy.h"
#include "core/types/status_macros.h"
#include "formats/scene_folder.h"
#include "lab/local/local_planner_client.h"
#include "lab/program/progress_line.h"
#include "lab/program/recording.h"
#include "lab/program/run_folder.h"
#include "lab/report/plan_names.h"
#include "lab/sim/episode.h"
#include "lab/sim/scene_world.h"

namespace plumescout::lab {
namespace {

struct RobotArguments {
  std::string server = "127.0.0.1:50551";
  std::string scene;
  std::string out = "out/robot";
  std::string mission = "demo";
  std::string robot = "robot-1";
  std::string strategy = MissionOptions{}.planning.strategy;
  double duration_s = 300.0;
  client::Following following = client::Following::kIdeal;
  std::string record;  // empty: a server plans
  bool realtime = false;
  bool raw_gas = false;
  std::uint64_t seed = 1;
};

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

EpisodeOptions MakeEpisodeOptions(const RobotArguments& arguments, EpisodeDisplay& display) {
  EpisodeOptions options;
  options.mission = arguments.mission;
  options.robot = arguments.robot;
  options.create.emplace();
  options.create->planning.strategy = arguments.strategy;
  options.create->seed = arguments.seed;
  options.duration_s = arguments.duration_s;
  options.following = arguments.following;
  options.realtime = arguments.realtime;
  options.correct_gas_lag = !arguments.raw_gas;
  options.simulated.seed = arguments.seed;
  options.on_plan = [&](const IssuedPlan& plan) { display.OnPlan(plan); };
  options.on_sample = [&](const MetricSample& sample, const MapSnapshot& map) {
    display.OnSample(sample, map);
  };
  return options;
}

std::string Verdict(const EpisodeResult& episode, double wall_s) {
  const MapMetrics& metrics = episode.samples.back().metrics;
  return absl::StrFormat(
      "%s after %.0f s simulated (%.1f s wall): map %.1f %% complete, RMSE %.2f ppm (all-zero map: "
      "%.2f), %d plans, %.0f m driven, %d of %d readings applied",
      episode.completed ? "Mission complete" : "Time is up", episode.simulated_s, wall_s,
      100.0 * metrics.completeness, metrics.rmse_ppm, metrics.rmse_zero_ppm, episode.plans.size(),
      episode.distance_m, episode.readings_applied, episode.readings_sent);
}

// By a server, or in this process with the mission's events recorded.
absl::StatusOr<EpisodeResult> RunPlanned(const RobotArguments& arguments, const SceneWorld& world,
                                         EpisodeOptions options) {
  if (arguments.record.empty()) {
    client::GrpcClientOptions link;
    link.target = arguments.server;
    return RunEpisode(*client::MakeGrpcPlannerClient(link), world, options);
  }
  PLUMESCOUT_RETURN_IF_ERROR(ApplyStrategyRow(options.create->planning));  // as servers do
  PLUMESCOUT_ASSIGN_OR_RETURN(Recorder recorder,
                              Recorder::Create(arguments.record, *options.create));
  LocalOptions local;
  local.on_event = [&recorder](const Event& event) { recorder.Record(event); };
  LocalPlannerClient planner(local);
  PLUMESCOUT_ASSIGN_OR_RETURN(EpisodeResult episode, RunEpisode(planner, world, options));
  PLUMESCOUT_RETURN_IF_ERROR(recorder.status());
  return episode;
}

absl::Status DriveRobot(const RobotArguments& arguments) {
  PLUMESCOUT_ASSIGN_OR_RETURN(Scene scene, ReadScene(arguments.scene));
  const SceneWorld world(std::move(scene));
  const absl::Time start = absl::Now();
  EpisodeDisplay display(arguments.duration_s, start);
  PLUMESCOUT_ASSIGN_OR_RETURN(const EpisodeResult episode,
                              RunPlanned(arguments, world, MakeEpisodeOptions(arguments, display)));
  const double wall_s = absl::ToDoubleSeconds(absl::Now() - start);
  display.line().Finish(Verdict(episode, wall_s));
  PLUMESCOUT_RETURN_IF_ERROR(WriteRunFolder(
      {world.scene(), episode, display.last_map(), arguments.strategy, arguments.seed, wall_s},
      arguments.out));
  std::cout << arguments.out << "/report.html\n";
  return absl::OkStatus();
}

}  // namespace

void AddRobotCommand(CLI::App& app, absl::Status& status) {
  CLI::App* robot = app.add_subcommand(
      "robot",
      "Drive a simulated robot through a scene, planned by a server over gRPC or in this process");
  const auto arguments = std::make_shared<RobotArguments>();
  robot->add_option("--scene", arguments->scene, "Scene folder: the true building and gas")
      ->required()
      ->check(CLI::ExistingDirectory);
  robot->add_option("--server", arguments->server, "host:port of plumescout-server")
      ->capture_default_str();
  robot
      ->add_option("--record", arguments->record,
                   "Plan in this process, without a server, and record the mission in this file")
      ->excludes("--server");
  robot->add_option("--out", arguments->out, "Folder for results")->capture_default_str();
  robot->add_option("--mission", arguments->mission, "Mission to join, made if it is not there")
      ->capture_default_str();
  robot->add_option("--robot", arguments->robot, "Name of the robot")->capture_default_str();
  robot->add_option("--strategy", arguments->strategy, "xit_gff, xit_fgf or xit_f")
      ->capture_default_str();
  robot->add_option("--duration", arguments->duration_s, "Longest simulated time, seconds")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  const std::map<std::string, client::Following> followings{
      {"ideal", client::Following::kIdeal}, {"proportional", client::Following::kProportional}};
  robot->add_option("--following", arguments->following, "How paths are followed")
      ->transform(CLI::CheckedTransformer(followings))
      ->default_str("ideal");
  robot->add_option("--seed", arguments->seed, "Seed of sensors and planner")
      ->capture_default_str();
  robot->add_flag("--realtime", arguments->realtime,
                  "At the pace of a wall clock instead of in lockstep");
  robot->add_flag("--raw-gas", arguments->raw_gas,
                  "Send gas readings as the sensor gives them, its lag not undone");
  robot->callback([arguments, &status] { status = DriveRobot(*arguments); });
}

}  // namespace plumescout::lab
