// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/robot_arguments.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "core/plan/sampling/site_lattice.h"
#include "core/plan/strategy.h"
#include "core/types/prior_map.h"
#include "core/types/status_macros.h"
#include "formats/map_server.h"
#include "lab/sim/team_starts.h"

namespace plumescout::lab {
namespace {

void AddObjectiveOptions(CLI::App& app, ObjectiveOptions& objective) {
  const std::map<std::string, ObjectiveKind> kinds{
      {"complete_map", ObjectiveKind::kCompleteMap},
      {"map_above_threshold", ObjectiveKind::kMapAboveThreshold},
      {"confirm_clean", ObjectiveKind::kConfirmClean},
      {"find_sources", ObjectiveKind::kFindSources}};
  app.add_option("--objective", objective.kind,
                 "What a mission that is made is for; it ends once that is met or refuted")
      ->transform(CLI::CheckedTransformer(kinds))
      ->default_str("complete_map");
  app.add_option("--objective-threshold", objective.threshold_ppm,
                 "Concentration that the objective is about, ppm");
  app.add_option("--objective-confidence", objective.confidence,
                 "How sure it is to be of each cell, as a share");
}

void AddMissionOptions(CLI::App& app, RobotArguments& arguments) {
  app.add_option("--scene", arguments.scene, "Scene folder: the true building and gas")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--server", arguments.server, "host:port of plumescout-server");
  app.add_option("--record", arguments.record,
                 "Plan in this process, without a server, and record the mission in this file")
      ->excludes("--server");
  app.add_flag("--known-map", arguments.known_map,
               "The mission knows the scene's map from the start");
  app.add_option("--prior-map", arguments.prior_map,
                 "YAML file of a map_server map that the mission knows from the start")
      ->check(CLI::ExistingFile)
      ->excludes("--known-map");
  app.add_option("--out", arguments.out, "Folder for results");
  app.add_option("--mission", arguments.mission, "Mission to join, made if it is not there");
  app.add_option("--robot", arguments.robot, "Name of the robot; others are numbered on from it");
  app.add_option("--robots", arguments.robots, "How many robots share the mission")
      ->check(CLI::Range(1, MissionOptions{}.max_robot_count));
  app.add_option("--start", arguments.starts,
                 "x,y,yaw where a robot starts, metres and radians; once for each robot "
                 "(default: the scene's start, others beside it)")
      ->default_str("");
  app.add_option("--strategy", arguments.strategy, absl::StrJoin(StrategyNames(), ", "));
  AddObjectiveOptions(app, arguments.objective);
  app.add_option("--duration", arguments.duration_s, "Longest simulated time, seconds")
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", arguments.seed, "Seed of sensors and planner")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  app.add_flag("--realtime", arguments.realtime,
               "At the pace of a wall clock instead of in lockstep");
  CLI::Option* command =
      app.add_option("--crash-command", arguments.crash_command,
                     "Shell command that kills the server; somebody has to start it again");
  app.add_option("--crash-at", arguments.crash_at_s,
                 "When to run that, seconds of simulated time; in lockstep the world waits")
      ->check(CLI::PositiveNumber)
      ->needs(command);
}

void AddWorldOptions(CLI::App& app, RobotArguments& arguments) {
  app.option_defaults()->group("World");
  app.add_option("--scene-start", arguments.scene_start_s,
                 "Time of the scene at which the mission begins, seconds");
  app.add_option("--ambient", arguments.world.ambient_ppm,
                 "Gas in all air beside the scene's, ppm; the mission takes it for clean air");
  const std::map<std::string, SeriesEnd> ends{{"hold", SeriesEnd::kHoldLastFrame},
                                              {"repeat", SeriesEnd::kRepeat}};
  app.add_option("--series-end", arguments.world.series_end,
                 "What the gas does when the scene's frames are over")
      ->transform(CLI::CheckedTransformer(ends))
      ->default_str("hold");
}

void AddLidarOptions(CLI::App& app, RobotArguments& arguments) {
  app.option_defaults()->group("LiDAR");
  app.add_option("--lidar-beams", arguments.lidar.beams, "Beams of a scan, evenly around");
  app.add_option("--lidar-range", arguments.lidar.max_range_m, "Longest range, metres");
  app.add_option("--lidar-noise", arguments.lidar.noise_sigma_m,
                 "Standard deviation of ranges, metres");
  app.add_option("--lidar-dropouts", arguments.lidar.dropout_share,
                 "Share of beams that say nothing");
  app.add_option("--scan-rate", arguments.rates.scan_hz, "Scans a second; 0: none");
}

void AddGasOptions(CLI::App& app, RobotArguments& arguments) {
  app.option_defaults()->group("Gas sensor");
  const std::map<std::string, GasSensorKind> kinds{{"pid", GasSensorKind::kPhotoIonisation},
                                                   {"co2", GasSensorKind::kCarbonDioxide}};
  app.add_option("--gas-sensor", arguments.gas_sensor,
                 "pid: photo-ionisation detector, fast; co2: infrared cell, slow and coarse")
      ->transform(CLI::CheckedTransformer(kinds))
      ->default_str("pid");
  GasSensorChanges& changes = arguments.gas_changes;
  app.add_option("--gas-lag", changes.time_constant_s,
                 "Its time constant, seconds (pid 0.5, co2 4)");
  app.add_option("--gas-noise", changes.noise_sigma_ppm, "Additive noise, ppm (pid 0.1, co2 10)");
  app.add_option("--gas-noise-share", changes.noise_share, "Noise as share of the reading (0.01)");
  app.add_option("--gas-detection-limit", changes.detection_limit_ppm,
                 "Lower concentrations read 0, ppm (pid 0.05)");
  app.add_option("--gas-saturation", changes.saturation_ppm,
                 "Higher concentrations read this, ppm (10000)");
  app.add_option("--gas-resolution", changes.resolution_ppm,
                 "Readings are multiples of it, ppm (co2 10)");
  app.add_option("--gas-rate", arguments.rates.gas_hz, "Readings a second; 0: none");
  app.add_flag("--raw-gas", arguments.raw_gas,
               "Nobody undoes the sensor's lag (default: the mission does, along the way)");
  app.add_flag("--point-gas", arguments.point_gas,
               "The robot undoes it, from each two readings for one place between them")
      ->excludes("--raw-gas");
  app.add_option("--gas-threshold", arguments.gas_threshold_ppm,
                 "Above it gas counts as a plume, ppm (default: a percentile of what is observed)");
  app.add_option("--dwell", arguments.dwell_s,
                 "Stop and sample: seconds to stand at each vertex of a trajectory");
  app.add_option("--settle", arguments.settling_s,
                 "Readings count only after so many seconds of standing; less than --dwell");
  app.add_option("--site-spacing", arguments.site_spacing_m,
                 "Metres between the sites that lhr, ipp_reward, random_sampling and sweep sample, "
                 "all over the scene")
      ->check(CLI::Range(0.05, 1000.0));
  app.add_option("--survey-stride", arguments.survey_stride,
                 "The survey of lhr and random_sampling takes every n-th site of every n-th row")
      ->check(CLI::Range(1, 1000));
}

void AddMotionOptions(CLI::App& app, RobotArguments& arguments) {
  app.option_defaults()->group("Motion");
  const std::map<std::string, client::Following> followings{
      {"ideal", client::Following::kIdeal}, {"proportional", client::Following::kProportional}};
  app.add_option("--following", arguments.following, "How paths are followed")
      ->transform(CLI::CheckedTransformer(followings))
      ->default_str("ideal");
  app.add_option("--late", arguments.most_late_s,
                 "Ideal following: each leg falls behind by up to so many seconds");
  app.add_option("--replan-period", arguments.replan_period_s,
                 "Robots ask for better plans on their way, so many seconds after the last began; "
                 "0: when they are there (default: as plans advise)")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--speed", arguments.speed_mps,
                 "Speed of robot and plans, metres a second (1.25)");
  app.add_option("--max-turn", arguments.max_turn_rad_per_s,
                 "Turn rate of the robot, and of plans if given, radians a second (2)");
  app.add_option("--max-acceleration", arguments.max_acceleration_mps2,
                 "Acceleration of robot and plans, m/s^2 (no limit)");
  PoseErrorOptions& pose = arguments.pose_error;
  app.add_option("--pose-noise", pose.position_sigma_m,
                 "Noise of the pose told to the planner, metres");
  app.add_option("--yaw-noise", pose.yaw_sigma_rad, "Noise of its heading, radians");
  app.add_option("--pose-drift", pose.drift_m_per_sqrt_s,
                 "Random walk of that pose, metres/sqrt(s)");
  app.add_option("--yaw-drift", pose.drift_rad_per_sqrt_s,
                 "Random walk of its heading, rad/sqrt(s)");
  app.add_option("--loop-closure", pose.closed_every_s,
                 "Every so many seconds a robot knows again where it is and was, and corrects what "
                 "these walks did to its poses (never)");
}

GasSensorOptions SensorOf(const RobotArguments& arguments) {
  GasSensorOptions sensor = arguments.gas_sensor == GasSensorKind::kCarbonDioxide
                                ? CarbonDioxideCell()
                                : PhotoIonisationDetector();
  const GasSensorChanges& changes = arguments.gas_changes;
  sensor.time_constant_s = changes.time_constant_s.value_or(sensor.time_constant_s);
  sensor.noise_sigma_ppm = changes.noise_sigma_ppm.value_or(sensor.noise_sigma_ppm);
  sensor.noise_share = changes.noise_share.value_or(sensor.noise_share);
  sensor.detection_limit_ppm = changes.detection_limit_ppm.value_or(sensor.detection_limit_ppm);
  sensor.saturation_ppm = changes.saturation_ppm.value_or(sensor.saturation_ppm);
  sensor.resolution_ppm = changes.resolution_ppm.value_or(sensor.resolution_ppm);
  return sensor;
}

absl::Status TakePriorMap(const RobotArguments& arguments, const SceneWorld& world,
                          MissionOptions& mission) {
  if (!arguments.known_map && arguments.prior_map.empty()) return absl::OkStatus();
  Grid<CellState> map = world.occupancy();
  if (!arguments.known_map) {
    PLUMESCOUT_ASSIGN_OR_RETURN(map, ReadMapServer(arguments.prior_map));
  }
  StartWith(std::make_shared<const Grid<CellState>>(std::move(map)), mission);
  return Validate(mission);
}

absl::StatusOr<MissionOptions> MissionOf(const RobotArguments& arguments, const SceneWorld& world) {
  MissionOptions mission;
  PlanningOptions& planning = mission.planning;
  planning.strategy = arguments.strategy;
  planning.dwell_s = arguments.dwell_s;
  if (StopsAtSites(arguments.strategy)) {
    planning.sites.spacing_m = arguments.site_spacing_m;
    planning.sites.survey_stride = arguments.survey_stride;
    planning.sites.region =
        RegionOver(world.scene().geometry(), arguments.site_spacing_m, arguments.survey_stride);
  }
  const std::vector<double>& speeds_mps = arguments.team.speeds_mps;
  if (!speeds_mps.empty()) {
    planning.speed_mps = *std::max_element(speeds_mps.begin(), speeds_mps.end());
  }
  planning.speed_mps = arguments.speed_mps.value_or(planning.speed_mps);
  planning.max_turn_rate_rad_per_s = arguments.max_turn_rad_per_s.value_or(0.0);
  planning.max_acceleration_mps2 = arguments.max_acceleration_mps2.value_or(0.0);
  mission.frontier.fixed_gas_threshold_ppm = arguments.gas_threshold_ppm;
  mission.gas.background_mean_ppm = arguments.world.ambient_ppm;
  mission.seed = arguments.seed;
  mission.objective = arguments.objective;
  PLUMESCOUT_RETURN_IF_ERROR(Validate(mission.objective));
  PLUMESCOUT_RETURN_IF_ERROR(TakePriorMap(arguments, world, mission));
  return mission;
}

SimulatedRobotOptions RobotOf(const RobotArguments& arguments) {
  SimulatedRobotOptions robot;
  robot.max_forward_mps = arguments.speed_mps.value_or(robot.max_forward_mps);
  robot.max_turn_rad_per_s = arguments.max_turn_rad_per_s.value_or(robot.max_turn_rad_per_s);
  robot.max_acceleration_mps2 = arguments.max_acceleration_mps2;
  robot.lidar = arguments.lidar;
  robot.gas_sensor = SensorOf(arguments);
  robot.pose_error = arguments.pose_error;
  robot.pace.most_late_s = arguments.most_late_s;
  if (arguments.realtime) robot.start_time_ns = absl::ToUnixNanos(absl::Now());
  robot.scene_start_s = arguments.scene_start_s;
  robot.seed = arguments.seed;
  return robot;
}

absl::StatusOr<Pose2> ParseStart(const std::string& text) {
  const std::vector<std::string> parts = absl::StrSplit(text, ',');
  Pose2 pose;
  const bool ok = parts.size() == 3 && absl::SimpleAtod(parts[0], &pose.x_m) &&
                  absl::SimpleAtod(parts[1], &pose.y_m) &&
                  absl::SimpleAtod(parts[2], &pose.yaw_rad);
  if (ok) return pose;
  return absl::InvalidArgumentError(absl::StrCat("--start ", text, " must be x,y,yaw"));
}

absl::StatusOr<std::vector<Pose2>> StartsOf(const RobotArguments& arguments,
                                            const SceneWorld& world, double body_radius_m) {
  if (arguments.starts.empty()) return TeamStarts(world, arguments.robots, body_radius_m);
  if (static_cast<int>(arguments.starts.size()) != arguments.robots) {
    return absl::InvalidArgumentError(absl::StrCat("--start is given ", arguments.starts.size(),
                                                   " times for --robots ", arguments.robots));
  }
  std::vector<Pose2> starts;
  for (const std::string& text : arguments.starts) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Pose2 start, ParseStart(text));
    starts.push_back(start);
  }
  return starts;
}

// A server measures clocks by its own, which in lockstep goes slower or faster than the world.
absl::Status CheckClocks(const RobotArguments& arguments) {
  const bool are_measured = !arguments.record.empty() || arguments.realtime;
  if (are_measured || !HasWrongClocks(arguments.team)) return absl::OkStatus();
  return absl::InvalidArgumentError(
      "--clock-offset and --clock-drift are for --record or --realtime: over gRPC in lockstep "
      "nobody could find out");
}

// Only who is placed on its path falls behind by so much; wheels do what they do.
absl::Status CheckLateness(const RobotArguments& arguments) {
  const bool is_placed = arguments.following == client::Following::kIdeal;
  if (is_placed || arguments.most_late_s == 0.0) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat("--late ", arguments.most_late_s,
                                                 " is for --following ideal, not proportional"));
}

}  // namespace

void AddRobotOptions(CLI::App& app, RobotArguments& arguments) {
  app.option_defaults()->always_capture_default();
  AddMissionOptions(app, arguments);
  AddWorldOptions(app, arguments);
  AddLidarOptions(app, arguments);
  AddGasOptions(app, arguments);
  AddMotionOptions(app, arguments);
  AddTeamOptions(app, arguments.team);
}

absl::StatusOr<PlannedEpisode> PlanEpisode(const RobotArguments& arguments,
                                           const SceneWorld& world) {
  PlannedEpisode planned;
  EpisodeOptions& options = planned.options;
  options.mission = arguments.mission;
  PLUMESCOUT_ASSIGN_OR_RETURN(options.create, MissionOf(arguments, world));
  options.duration_s = arguments.duration_s;
  options.following = arguments.following;
  options.rates = arguments.rates;
  options.replan_period_s = arguments.replan_period_s;
  options.realtime = arguments.realtime;
  options.correct_gas_lag = !arguments.raw_gas;
  options.mission_corrects_lag = !arguments.raw_gas && !arguments.point_gas;
  options.gas_settling_s = arguments.settling_s;
  options.simulated = RobotOf(arguments);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Pose2> starts,
                              StartsOf(arguments, world, options.simulated.body_radius_m));
  const std::vector<RobotId> names = TeamNames(arguments.robot, arguments.robots);
  options.robot = names.front();
  options.simulated.start = starts.front();
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<RobotTraits> traits,
                              MakeTraits(arguments.team, arguments.robots));
  options.traits = traits.front();
  for (std::size_t i = 1; i < names.size(); ++i) {
    planned.teammates.push_back({names[i], starts[i], arguments.seed + i, traits[i]});
  }
  PLUMESCOUT_RETURN_IF_ERROR(CheckClocks(arguments));
  PLUMESCOUT_RETURN_IF_ERROR(CheckLateness(arguments));
  const bool in_lockstep_here = !arguments.record.empty() && !arguments.realtime;
  if (in_lockstep_here && HasWrongClocks(arguments.team)) {
    options.world_time_ns =
        std::make_shared<std::atomic<std::int64_t>>(options.simulated.start_time_ns);
  }
  return planned;
}

}  // namespace plumescout::lab
