// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/frontier.h"
#include "core/types/gas_sensor.h"
#include "core/types/grid.h"
#include "core/types/ids.h"
#include "core/types/objective.h"
#include "core/types/plan.h"
#include "core/types/polygon.h"
#include "core/types/pose2.h"
#include "core/types/robot_frame.h"

namespace plumescout {

struct RobotState {
  RobotId id;
  double radius_m = 0.2;
  bool has_pose = false;
  Pose2 pose;
  std::int64_t applied_sequence = 0;
  std::int64_t rejected_observations = 0;
  // Not heard of for robot_silence_s while others were: it masks no beam, claims no goal and keeps
  // no mission from completing until it is.
  bool silent = false;
  RobotFrame frame = {};             // of the poses that it reports; `pose` above is in frame map
  std::int64_t clock_offset_ns = 0;  // see ClockOffsetNoted
  std::optional<double> battery_share = std::nullopt;  // none: it did not tell
  bool ordered_home = false;
  // Its scans contradict the map, which does not take them until its poses are corrected.
  bool frame_suspect = false;

  friend bool operator==(const RobotState&, const RobotState&) = default;
};

// What waits, moved or was merged on its way into the gas posterior; nothing is dropped silently.
struct GasCounters {
  std::int64_t readings = 0;            // received
  std::int64_t in_posterior = 0;        // on a free cell now
  std::int64_t moved_to_neighbour = 0;  // of those, moved to a free cell next to their own
  std::int64_t waiting = 0;             // their cell is not free (yet, or any more)

  friend bool operator==(const GasCounters&, const GasCounters&) = default;
};

// How good the gas posterior is: what is certified, and what was measured.
struct GasQuality {
  double mean_error_ppm = 0.0;        // no mean is farther from the exact one, beside rounding
  double variance_error_ratio = 0.0;  // nor any variance, as share of the exact one
  std::int64_t aged_to_ns = 0;        // readings have the precisions of this instant or a later
  double ageing_error_ratio = 0.0;    // variances may be too small by this share for that
  std::int64_t refreshes = 0;         // batches of changes brought into the fields
  std::int64_t epochs = 0;            // recomputations from scratch that were adopted
  std::int64_t healed = 0;            // recomputations since a variance was not positive
  std::int64_t failures = 0;          // refreshes and adoptions of which no field came
  double drift_mean_ppm = 0.0;        // largest found at the last adoption
  double drift_variance_ratio = 0.0;
  // How much worse readings fit the field than its precisions say, which is what published
  // variances are scaled by unless that grows with the concentration; 1: not worse, or not
  // estimated.
  double noise_scale = 1.0;
  double noise_log_stddev = 0.0;  // of ln noise_scale; 0 if that is not estimated
  // What lambda_p and lambda_d are of those of the options, in a field whose variances are scaled
  // by noise_scale; 1: given.
  double prior_precision_scale = 1.0;
  double prior_precision_log_stddev = 0.0;  // of its logarithm; 0 if it is not learned
  // What published variances of clean air are scaled by.
  double clean_air_scale = 1.0;

  friend bool operator==(const GasQuality&, const GasQuality&) = default;
};

// What audits of the gas posterior found: an independent implementation computed means and
// variances from the same map and readings. Of this process only: no part of a mission's state.
struct GasAudits {
  std::int64_t audits = 0;      // that came to an end
  double mean_ppm = 0.0;        // largest difference of means at the last one
  double variance_ratio = 0.0;  // of variances, as share of the independent one
  std::int64_t alarms = 0;      // found more than was certified; each had the field made anew

  friend bool operator==(const GasAudits&, const GasAudits&) = default;
};

// How the field of one gas stands.
struct GasStatus {
  std::string species;  // empty: the mission names no gas
  GasCounters counters;
  GasQuality quality;
  GasAudits audits;

  friend bool operator==(const GasStatus&, const GasStatus&) = default;
};

// How much of the ground that robots can reach, as far as it is mapped, is known of the first gas.
struct Completeness {
  double reachable_area_m2 = 0.0;
  double observed_area_m2 = 0.0;  // of that: where variances count as observed

  friend bool operator==(const Completeness&, const Completeness&) = default;
};

// Everything on a map at one revision but its rasters. What it says of gas is of the first one.
struct MapStatus {
  std::int64_t revision = 0;
  double gas_threshold_ppm = 0.0;   // tau_gas of [XIT] Eq. (17)
  std::vector<Frontier> frontiers;  // both kinds
  std::vector<RobotState> robots;
  GasCounters gas_counters;
  GasQuality gas_quality;
  GasAudits gas_audits;
  std::vector<SensorOffset> sensor_offsets;  // of sensors whose offset was not known
  std::vector<GasStatus> gases;   // of a mission that names its gases: all, the first first
  std::vector<Polygon> keep_out;  // where nobody may drive
  MissionPhase phase = MissionPhase::kExploring;
  std::optional<ObjectiveStatus> objective;  // none: a complete map
  std::string objective_explanation;         // that in a sentence; empty: none
  Completeness completeness;
};

// The rasters of one gas. Off the free cells they are NaN.
struct GasLayers {
  std::string species;
  Grid<float> mean_ppm;
  Grid<float> variance_ppm2;
};

// A whole map as readers see it. Off the free cells mean and variance are NaN.
struct MapSnapshot : MapStatus {
  Grid<CellState> occupancy;
  Grid<float> gas_mean_ppm;
  Grid<float> gas_variance_ppm2;
  std::vector<GasLayers> further_gases = {};  // beside the first
};

}  // namespace plumescout
