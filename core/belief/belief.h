// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/belief/sampled_cells.h"
#include "core/gas/gas_what_if.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/ids.h"
#include "core/types/map_snapshot.h"
#include "core/types/objective.h"
#include "core/types/options.h"
#include "core/types/plan.h"

namespace plumescout {

// Goals nearer to each other than this are one errand: one robot is enough for both.
inline constexpr double kClaimRadius_m = 0.5;
// And nearer than this they are one place. A frontier that a visit has pushed on by more is new.
inline constexpr double kSamePlaceRadius_m = 0.15;

// Whatever they are for, but that one who drives about at random does nobody's errand.
inline bool IsSameErrand(const Goal& claimed, const Goal& goal) {
  const bool at_random = claimed.kind == GoalKind::kRandomFreeSpace;
  return at_random == (goal.kind == GoalKind::kRandomFreeSpace) &&
         Distance_m(claimed.position, goal.position) < kClaimRadius_m;
}
inline bool ClaimCovers(const Goal& claimed, const Goal& goal) {
  return claimed.kind == goal.kind && Distance_m(claimed.position, goal.position) < kClaimRadius_m;
}
inline bool SamePlace(const Goal& a, const Goal& b) {
  return a.kind == b.kind && Distance_m(a.position, b.position) < kSamePlaceRadius_m;
}

// The end of a robot's live plan: not to be handed out to another robot.
struct GoalClaim {
  RobotId robot;
  PlanId plan = 0;
  Goal goal;
  std::int64_t expires_ns = 0;  // in sample time: a stalled robot does not keep its goal for ever
};

// A goal that failed or was visited without change, until it expires or the map near it changes.
struct SetAsideGoal {
  Goal goal;
  std::string reason;           // "reported blocked", "visited without change"
  std::int64_t expires_ns = 0;  // in sample time
};

// What planning needs to know of one robot's history.
struct RobotRecord {
  RobotState state;
  std::int64_t plans_issued = 0;
  int fruitless_fallbacks = 0;        // random places reached in a row that revealed nothing
  std::optional<Point2> first_place;  // of its first observation
  double travelled_m = 0.0;           // since then
  PlanId last_plan = 0;               // its latest; 0: none yet
  // Of the latest plan while it is live; null if it has ended, or is to stay.
  std::shared_ptr<const Trajectory> live_trajectory;
  std::optional<Goal> live_goal;     // where that ends
  std::int64_t live_arrival_ns = 0;  // when it is there by plan, in sample time
  bool battery_low = false;          // since it fell below return_home_below_battery_share
  std::int64_t heard_ns = 0;         // sample time when it was last heard of; 0: never
  PlanId assigned_plan = 0;  // the live one, if others ordered it for the robot; 0: it did itself
  // Where it would go if others were not in the way: of a latest plan that has it stay or make way
  // the first goal that was rejected as kTraffic.
  std::optional<Goal> wanted_goal;
  // Since when it has wanted one or another such goal without a plan that led to one, in sample
  // time, though it may want none for now; 0: it has not.
  std::int64_t wanted_since_ns = 0;
  // How far along its live plan its poses have told that it is, in the plan's time.
  double live_gone_s = 0.0;
  // When its latest pose was taken, in sample time; 0: not known, or of before it registered last.
  std::int64_t pose_ns = 0;
};

// Whether home is where it drives, whatever it asks for.
inline bool IsSentHome(const RobotRecord& record) {
  return record.state.ordered_home || record.battery_low;
}

// What a mission knows of one of its gases.
struct GasField {
  std::shared_ptr<const Grid<float>> mean_ppm;       // NaN off free cells
  std::shared_ptr<const Grid<float>> variance_ppm2;  // NaN off free cells
  GasCounters counters;
  GasQuality quality;
  GasAudits audits;
  std::shared_ptr<const Grid<float>> error_variance_ppm2 = nullptr;
  std::shared_ptr<const SampledCells> sampled_cells = nullptr;

  // Of the concentration, for those who look at it; see GasMap::error_variance_ppm2.
  const std::shared_ptr<const Grid<float>>& published_variance_ppm2() const {
    return error_variance_ppm2 != nullptr ? error_variance_ppm2 : variance_ppm2;
  }
};

// Immutable snapshot of a mission that readers plan on and look at. Rasters are shared between
// snapshots while they do not change. All rasters have the geometry of `occupancy`.
struct Belief {
  std::int64_t revision = 0;           // number of the last applied event
  std::int64_t sample_time_ns = 0;     // newest sample time applied
  std::int64_t posterior_time_ns = 0;  // to which the posterior was refreshed
  std::shared_ptr<const MissionOptions> options;

  std::shared_ptr<const Grid<CellState>> occupancy;
  std::shared_ptr<const Grid<std::uint8_t>> traversable;  // 1: a robot may drive there
  std::shared_ptr<const Grid<float>> gas_mean_ppm;        // NaN off free cells
  // NaN off free cells. Of the model, which plans go by; what is known of the concentration in ppm
  // is Gas(0).published_variance_ppm2().
  std::shared_ptr<const Grid<float>> gas_variance_ppm2;
  std::shared_ptr<const Grid<float>> gas_error_variance_ppm2;  // null: that is the same
  // The model's as Relevance goes by it, whatever others promise; null: that goes by means alone.
  std::shared_ptr<const Grid<float>> gas_weight_variance_ppm2;
  std::shared_ptr<const GasWhatIf> gas_what_if;  // of the refresh; null before there is a free cell
  std::shared_ptr<const Grid<std::uint8_t>> sampled;  // 1: a gas reading was taken in the cell
  std::shared_ptr<const SampledCells> sampled_cells;  // of the same, when; null: not known
  GasCounters gas_counters;
  GasQuality gas_quality;
  GasAudits gas_audits;
  // Of the gases beside the first, of which the above is, in the order of the options.
  std::vector<GasField> further_gases;
  std::vector<SensorOffset> sensor_offsets;  // of all gases

  std::map<RobotId, RobotRecord> robots;
  std::vector<GoalClaim> claims;
  std::vector<SetAsideGoal> set_aside;
  MissionPhase phase = MissionPhase::kExploring;
  // When the first of the live plans that sample sites has its last sample, in sample time; none
  // without such a plan.
  std::optional<std::int64_t> next_map_update_ns;
  std::optional<ObjectiveStatus> objective;  // by the latest assessment; none: a complete map
  std::optional<std::int64_t> deadline_ns;   // when robots are to be home, in sample time

  const GridGeometry& geometry() const { return occupancy->geometry(); }
  // By place among the mission's gases. REQUIRES: there is one.
  GasField Gas(std::size_t species) const {
    if (species > 0) return further_gases[species - 1];
    return {gas_mean_ppm, gas_variance_ppm2,       gas_counters, gas_quality,
            gas_audits,   gas_error_variance_ppm2, sampled_cells};
  }
};

// Whether robots have nothing to do any more, whatever there is to learn: the objective is met or
// refuted, or it is too late.
inline bool IsOver(const Belief& belief) {
  return (belief.objective && IsConcluded(*belief.objective)) ||
         (belief.deadline_ns && belief.sample_time_ns >= *belief.deadline_ns);
}

// What watchers see beside the rasters: frontiers are found from all robots.
MapStatus MakeMapStatus(const Belief& belief);
// The map as watchers see it, with rasters copied.
MapSnapshot MakeMapSnapshot(const Belief& belief);

}  // namespace plumescout
