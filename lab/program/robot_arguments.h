// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "CLI/CLI.hpp"
#include "absl/status/statusor.h"
#include "client/motion.h"
#include "client/sensor_bridge.h"
#include "core/types/options.h"
#include "lab/program/team_arguments.h"
#include "lab/sim/episode.h"
#include "lab/sim/scene_world.h"

namespace plumescout::lab {

enum class GasSensorKind { kPhotoIonisation, kCarbonDioxide };

// What differs from the sensor's own figures.
struct GasSensorChanges {
  std::optional<double> time_constant_s;
  std::optional<double> noise_sigma_ppm;
  std::optional<double> noise_share;
  std::optional<double> detection_limit_ppm;
  std::optional<double> saturation_ppm;
  std::optional<double> resolution_ppm;
};

// The command line of `plumescout-lab robot`.
struct RobotArguments {
  std::string server = "127.0.0.1:50551";
  std::string scene;
  std::string out = "out/robot";
  std::string mission = "demo";
  std::string robot = "robot-1";
  std::string strategy = MissionOptions{}.planning.strategy;
  ObjectiveOptions objective;
  std::string record;  // empty: a server plans
  bool known_map = false;
  std::string prior_map;  // a file; empty: none
  int robots = 1;
  std::vector<std::string> starts;  // "x,y,yaw", one a robot; empty: near the scene's
  double duration_s = 300.0;
  bool realtime = false;
  // Once so much simulated time has passed, a command of the shell is run, to kill the server.
  std::optional<double> crash_at_s;
  std::string crash_command;
  std::uint64_t seed = 1;
  SceneWorldOptions world;
  double scene_start_s = 0.0;
  client::SensorRates rates;
  LidarOptions lidar;
  GasSensorKind gas_sensor = GasSensorKind::kPhotoIonisation;
  GasSensorChanges gas_changes;
  bool raw_gas = false;
  bool point_gas = false;
  std::optional<double> gas_threshold_ppm;
  double dwell_s = 0.0;
  double settling_s = 0.0;
  double site_spacing_m = SiteOptions{}.spacing_m;
  int survey_stride = 3;  // of rooms; the papers' 10 is for fields
  PoseErrorOptions pose_error;
  double most_late_s = 0.0;
  std::optional<double> replan_period_s;
  TeamArguments team;
  client::Following following = client::Following::kIdeal;
  std::optional<double> speed_mps;
  std::optional<double> max_turn_rad_per_s;
  std::optional<double> max_acceleration_mps2;
};

// `arguments` must outlive the parsing.
void AddRobotOptions(CLI::App& app, RobotArguments& arguments);

// An episode of `arguments` in a scene, its listeners still to be set.
struct PlannedEpisode {
  EpisodeOptions options;
  std::vector<Teammate> teammates;
};

// kInvalidArgument, naming the argument and its value: what does not parse, a wrong number of
// starts, no room for so many robots, a prior map that does not fit, clocks that are wrong where
// nobody finds out, lateness of robots that steer; else as ReadMapServer and MakeTraits.
absl::StatusOr<PlannedEpisode> PlanEpisode(const RobotArguments& arguments,
                                           const SceneWorld& world);

}  // namespace plumescout::lab
