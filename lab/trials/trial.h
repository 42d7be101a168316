// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "core/types/grid.h"
#include "core/types/map_snapshot.h"
#include "core/types/options.h"
#include "lab/rivals/kernel_dmv.h"
#include "lab/rivals/team_rival.h"
#include "lab/sim/episode.h"
#include "lab/sim/metrics.h"
#include "lab/sim/scene_world.h"
#include "lab/trials/map_calibration.h"
#include "lab/trials/other_entropies.h"
#include "lab/trials/team_watch.h"

namespace plumescout::lab {

// What the robots of a trial are like, beside what the mission says.
struct TrialRobot {
  double lidar_range_m = 8.0;
  double plan_latency_s = 0.1;          // that it stands for each plan
  double replan_period_s = 0.0;         // on its way, see client::RobotLoopOptions
  bool corrects_gas_lag = true;         // undoes the lag of its gas sensor, which it knows
  bool leaves_lag_to_mission = false;   // instead the mission does, along the way
  bool stops_without_frontier = false;  // the trial ends with the first plan that goes to none

  friend bool operator==(const TrialRobot&, const TrialRobot&) = default;
};

// One robot or several, one building, one way to plan.
struct Trial {
  const MissionOptions* mission = nullptr;  // its seed is the trial's
  const SceneWorld* world = nullptr;
  int robots = 1;                     // that share the mission, from TeamStarts, >= 1
  std::uint64_t seed = 1;             // of planner and of the first robot's sensors
  double duration_s = 300.0;          // simulated, [XIT] section VI-B
  double most_late_s = 0.0;           // legs fall behind by up to this, see PaceOptions
  std::vector<double> map_times_s{};  // when the gas map is kept, ascending
  TrialRobot robot{};
  bool ghosts = false;             // robots neither see each other nor run into each other
  std::optional<TeamRule> rule{};  // of others, that chooses among the mission's frontiers
  // Also map the same readings by Kernel DM+V, over the whole building, and tell its error.
  std::optional<KernelDmvOptions> peer{};
  // Also tell the entropy at the end by other variances.
  bool tells_other_entropies = false;
  // Also map the same readings, each at one place, in this field, and judge that map.
  std::optional<GasOptions> second_field{};
  // Told what the robots did, and the map at the end; may be empty.
  std::function<void(const TeamResult&, const MapSnapshot&)> on_end{};
};

struct CurvePoint {
  double time_s = 0.0;
  MapMetrics metrics;
};

// How robots of one team got on with each other.
struct TeamRecord {
  int legs = 0;          // that ended
  int blocked_legs = 0;  // of those, for something stood in the way
  int contacts = 0;      // of two bodies
  int encounters = 0;    // of two robots nearer than their radii and kEncounterMargin_m
  std::optional<double> closest_m{};  // two centres ever came; none of one robot, or of ghosts
  double waiting_s = 0.0;             // that plans had robots stand before they went
  double robot_s = 0.0;               // of all robots together
  double plan_wall_s = 0.0;           // median from asking to answer; differs from run to run
  TeamFindings findings = {};         // nothing of one robot
};
inline constexpr double kEncounterMargin_m = 0.1;

struct TrialRecord {
  std::vector<CurvePoint> curve;  // at 0, every 5 s, and at the end
  // At the map times, or at the end if that came before; on the scene's grid; NaN: not estimated.
  std::vector<Grid<float>> mean_ppm;
  MapCalibration calibration;  // of the mission's own map, at the end
  int gas_readings = 0;
  double distance_m = 0.0;
  int plans = 0;
  int collisions = 0;
  bool completed = false;               // the planner said so before the time was up
  std::optional<double> peer_rmse_ppm;  // of Kernel DM+V in critical cells, at the end
  std::optional<OtherEntropies> other_entropies;
  std::optional<MapMetrics> second_field;  // at the end
  TeamRecord team;
};

// Drives the robots through the building, planned in this process, in lockstep: the same trial
// gives the same record on any machine. The posterior is brought up to date where plans and metrics
// ask for it. Errors: as RunEpisode.
absl::StatusOr<TrialRecord> RunTrial(const Trial& trial);

}  // namespace plumescout::lab
