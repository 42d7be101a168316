// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/polygon.h"
#include "core/types/pose2.h"
#include "core/types/site_options.h"

namespace plumescout {

// Occupancy grid; paper symbols of [XIT] Eq. (1) and Table I.
struct OccupancyOptions {
  double resolution_m = 0.1;                     // [0.01, 50]
  double inflation_radius_m = 0.2;               // [0, 5], farther than this from any occupied cell
  double free_threshold_probability = 0.25;      // tau_free, probability, (0, 0.5)
  double occupied_threshold_probability = 0.65;  // tau_occ, probability, (0.5, 1)
  double hit_log_odds = 0.85;                    // (0, 50]
  double miss_log_odds = -0.4;                   // [-50, 0)
  double clamp_log_odds = 3.5;  // beyond the log-odds of both thresholds, at most 50
  double max_extent_m = 200.0;  // the map never grows beyond this width or height, [1, 20000]
  std::int64_t max_cell_count = 4'000'000;  // nor beyond this many cells
  // A return counts so far behind the surface that it came from, half a cell at most, [0, 1]; 0:
  // where it ends (docs/decisions/0034-returns-behind-their-surface.md).
  double surface_depth_m = 0.01;
};
// As of [XIT]: a return counts where it ends.
OccupancyOptions PublishedOccupancyOptions();

// Gas posterior; design of the GMRF with precisions in ppm^-2. Of [XIT] Table I are lambda_p, the
// unit, and m_0; lambda_o and lambda_d are ours (docs/decisions/0029-the-default-field.md), for the
// paper's see PublishedGasOptions().
enum class GasScale { kLinear, kSquareRoot };
enum class GasPrecisions { kFixed, kLearned };
struct GasOptions {
  double prior_precision_per_ppm2 = 3.0;          // lambda_p (sigma_r^2), > 0
  double observation_precision_per_ppm2 = 100.0;  // lambda_o (sigma_s^2), > 0
  double background_precision_per_ppm2 = 0.009;   // lambda_d (sigma_d^2), > 0
  double background_mean_ppm = 0.0;               // m_0
  // A reading's variance grows by 1/lambda_o in this time (lambda_t = half-life * lambda_o);
  // 0: readings do not age; else [0.001, 1e9].
  double ageing_half_life_s = 0.0;
  // A gas cell is this many occupancy cells wide and high, [1, 16].
  int lattice_factor = 1;
  // Whether lambda_d is of the area of an occupancy cell, so that a coarser lattice has the same
  // field (core/gas/coarse_prior.h); false: of a gas cell, whatever its area, and the field is
  // smoother in metres on a coarser lattice.
  bool background_by_area = true;
  // Of sample time. Refreshes that no plan asks for are this far apart, those for the sake of
  // readings and those for the sake of the map each among themselves; [0.01, 3600].
  double refresh_period_s = 0.05;
  // kappa, [0, 10]: a reading z that brings no variance has max(1 / lambda_o, (kappa |z - m_0|)^2),
  // for what gusts do to gas grows with it; 0: 1 / lambda_o whatever it reads. [LHR] section II-A.
  double observation_stddev_share = 0.0;
  // The field is computed on tiles of 64 occupancy cells no farther than this from one where a
  // robot has scanned or read, metres, [0, 1e6]; elsewhere it has its prior. 0: everywhere. A known
  // map at most twice as wide and high counts as visited.
  double field_reach_m = 25.0;
  // Servers compare the posterior with an independent one after the first epoch and after every so
  // many from then on, [0, 1000000]; 0: never.
  int audit_period_epochs = 30;
  // What is Gaussian: concentrations, or their roots. Then the lambda are of roots, in ppm^-1.
  GasScale scale = GasScale::kLinear;
  // Whether the variances that are published are scaled by how well readings fit the field (see
  // NoiseScale). Plans go by those of the model.
  bool estimate_noise = true;
  // Whether that scale grows with the concentration (LevelScale). Only where noise is estimated, of
  // linear fields with fixed precisions; others have one scale.
  bool noise_by_level = true;
  // Whether lambda_p and lambda_d, in their ratio, follow from the readings
  // (core/gas/prior_scale.h); those above are then where that begins. Learned ones need
  // estimate_noise.
  GasPrecisions precisions = GasPrecisions::kFixed;
  // By how much less than the field says there is where robots that seek gas have not read
  // (core/gas/unread_discount.h), [0, 10]; 0: as it says.
  double unread_discount_ratio = 0.6;
  // Where published variances are by level: how far gusts keep the truth from a mean, as share of
  // the concentration (NoiseEstimate::VarianceOf_ppm2), [0, 1]; 0: by the field's variance alone.
  double gust_ratio = 0.14;
};

// The same with the precisions of [XIT] Table I, lambda_o = 10 and lambda_d = 0.001, one scale of
// noise, lambda_d of a gas cell, and the field told as it is.
GasOptions PublishedGasOptions();

inline constexpr int kMostLatticeFactor = 16;

// A gas of a mission that maps several, each with a field of its own (core/types/species.h).
// Numbers that it has are its field's in place of those of GasOptions; the first has none.
struct GasSpecies {
  std::string name;  // the alphabet of RobotId
  std::optional<double> prior_precision_per_ppm2;
  std::optional<double> observation_precision_per_ppm2;
  std::optional<double> background_precision_per_ppm2;
  std::optional<double> background_mean_ppm;

  friend bool operator==(const GasSpecies&, const GasSpecies&) = default;
};

// Occupancy and gas frontiers; [XIT] section V.
enum class WgfdScope { kReachable, kLocal };
struct FrontierOptions {
  int min_occupancy_cell_count = 8;  // >= 1
  int min_gas_cell_count = 5;        // >= 1
  // Of epsilon_inf, in (0, 10]; observed: eps <= ratio * eps_inf.
  double observed_variance_ratio = 0.7;
  std::optional<double> observed_variance_ppm2;   // overrides the ratio
  double gas_percentile = 10.0;                   // p of [XIT] Eq. (17), [0, 100]
  double min_gas_threshold_ppm = 2.0;             // tau_gas,min, > 0
  std::optional<double> fixed_gas_threshold_ppm;  // replaces Eq. (17), > 0
  WgfdScope wgfd_scope = WgfdScope::kReachable;
};

// GFF, FGF and F of [XIT]; ours: frontiers of both kinds and places where readings tell much.
enum class GoalPolicy { kGasFirst, kOccupancyFirst, kOccupancyOnly, kEverything };
enum class CostKind { kUcb, kEuclidean, kVertices };
enum class SamplingKind { kSystematic, kIid };
enum class SelectionRule { kLeastCost, kMeanUcb, kInformationRate };
// What finds paths; the last five are baselines of ompl_planners.
enum class PathKind {
  kXit,
  kAnytimeXit,
  kGridExact,
  kRrt,
  kRrtStar,
  kInformedRrtStar,
  kBitStar,
  kPrmStar,
};

// One row of the strategy table: where to go, how to get there, which to take.
struct PlanningOptions {
  std::string strategy = "plumescout";  // name of the row, see core/plan/strategy.h
  GoalPolicy goal_policy = GoalPolicy::kEverything;
  bool draw_goals = false;  // true: at most max_goal_count drawn at random within a kind (paper)
  int max_goal_count = 5;   // see core/plan/goals/goal_policy.h; also the most fallback goals
  double min_goal_distance_m = 0.3;  // goals nearer than this are passed over, >= 0
  PathKind paths = PathKind::kXit;
  CostKind cost = CostKind::kUcb;  // expansion, [XIT] Eq. (12)
  CostKind selection_cost = CostKind::kUcb;
  SelectionRule selection_rule = SelectionRule::kInformationRate;
  double alpha_per_m = 0.0;      // [XIT] Eq. (12), [0, 1e9]
  double beta = 1.0;             // [XIT] Eq. (8), [0, 1e9]
  bool raw_variance = false;     // Eq. (8) as printed: variance in ppm^2
  int sample_count = 300;        // N, [1, 100000]
  int nearest_sample_count = 3;  // k_n, [1, 100]
  double uniform_share = 0.2;    // epsilon of Eq. (14), [0, 1]
  SamplingKind sampling = SamplingKind::kSystematic;
  double radius_factor = 1.1;   // gamma / gamma_RGG, > 0
  bool mixture_radius = false;  // gamma* = epsilon^(-1/2) gamma
  // No edge is tried that is longer than this, metres (ours), however few samples there are for the
  // area, for nearly every such edge of a cluttered map is blocked; 0: no limit (paper); [0, 1000].
  double max_connection_radius_m = 5.0;
  bool grid_guard = true;  // complete missed goals on the grid
  // Goal cells are vertices, where paths end (ours); false: paths end at that of the goal's
  // neighbours that is the cheapest to reach (paper).
  bool goal_vertices = true;
  // Search guided by [XIT] section IV-C's UCB-aware h-hat in place of the admissible distance.
  bool informed_heuristic = false;
  // Free the tree's paths of detours between its samples (ours).
  bool straighten = true;
  // Readings expected along a path when its information is priced, [0.01, 1000].
  double reading_rate_hz = 2.0;
  // The gas field has no cells behind an occupancy frontier, so what readings there would tell
  // cannot be priced (ours). Where information is priced it counts as this much, nats, [0, 1e9]; in
  // a field of other precisions in proportion to what a reading tells (`InField` in core/plan).
  // Found by trial with the published precisions, where from 10 to 30 are equal
  // (docs/decisions/0007-own-strategy.md): with none, rooms that promise little stay unseen.
  double unseen_information_nats = 20.0;
  // A robot under way keeps its goal unless another is better by more than this share, [0, 1].
  double commitment_margin_share = 0.0;
  double speed_mps = 1.25;     // > 0
  double dwell_s = 0.0;        // stop-and-sample at each vertex, >= 0
  double set_aside_s = 120.0;  // expiry of goal memory, seconds of sample time, (0, 1e9]
  // When no frontier is left, go first to places whose gas is unobserved (ours); false: to random
  // free places only (paper).
  bool fallback_to_unobserved = true;
  int fallback_limit = 2;  // random places reached in vain that end the mission, [1, 1000]

  // A robot waits until its way is clear of the live plans of others (core/traffic), or takes
  // another way; false: robots are on their own (ours).
  bool yield_to_robots = true;
  // Beside both radii, between a robot on its way and others on theirs, [0, 10]: what keeping to a
  // trajectory and poses err by, 2.5 sigma of 5 cm each.
  double robot_clearance_m = 0.25;

  // Where information is priced, what the live plans of other robots are about to tell counts as
  // told (core/plan/anticipation.h, ours); false: it is priced again.
  bool anticipate_robots = true;
  // Each robot keeps to an area of its own, all with about as much to do
  // (core/plan/goals/own_area.h, ours), and leaves it once nothing is left there; false: it goes
  // where it likes.
  bool balanced_areas = false;
  // How long after it has set out a robot of a team is advised to ask for a better plan, seconds of
  // driving, [0, 3600] (Plan::replan_after_s, ours); 0: when it is there.
  double team_replan_period_s = 1.5;

  // How trajectories are timed. 0: no limit; else [0.001, 100]. With either limit the robot stops
  // at every corner and turns on the spot.
  double max_acceleration_mps2 = 0.0;    // along the path, of speeding up and of braking
  double max_turn_rate_rad_per_s = 0.0;  // on the spot
  // How far a robot may drive in the mission, metres, [0, 1e9]; 0: as far as it likes. A goal from
  // which less would be left than (1 + return_margin_share) times the way home is over budget.
  double travel_budget_m = 0.0;
  double return_margin_share = 0.1;  // [0, 10]
  bool return_home = false;          // before the mission is complete, the robot drives home
  // From a robot's latest pose to its leaving by the new plan, seconds, [0, 60]: meanwhile it
  // follows its live plan.
  double planning_latency_s = 0.0;

  SiteOptions sites;  // of strategies that stop and sample
};

// What a mission is for (core/belief/objective_cells.h). All but the first are of the mission's
// first gas, and need a threshold.
enum class ObjectiveKind {
  kCompleteMap,        // all there is to know; neither met nor refuted
  kMapAboveThreshold,  // where there is more than the threshold
  kConfirmClean,       // that there is nowhere more than the threshold
  kFindSources,        // which place is the strongest, if it is above the threshold
};
struct ObjectiveOptions {
  ObjectiveKind kind = ObjectiveKind::kCompleteMap;
  double threshold_ppm = 0.0;  // (0, 1e6]; 0: none, of kCompleteMap alone
  double confidence = 0.95;    // of a cell's being decided, [0.501, 0.9999]
  // How well places are to be known, [0, 100]: the edge of what is above the threshold, and the
  // strongest place.
  double radius_m = 1.0;
  // Mission time, from its first observation on, by which robots are home: plans that do not come
  // back by then are not taken. [0, 1e9]; 0: none.
  double deadline_s = 0.0;
  // A verdict that rests on there being nothing left to know is one once it has held for so long,
  // of sample time, or robots have nothing left to do: a door that is shut for a moment hides what
  // lies behind it. [0, 3600]; 0: at once.
  double hold_s = 10.0;
};

struct MissionOptions {
  OccupancyOptions occupancy;
  GasOptions gas;
  FrontierOptions frontier;
  PlanningOptions planning;
  ObjectiveOptions objective;
  double pose_limit_m = 1000.0;  // |x|, |y| of any pose, > 0
  double max_range_m = 100.0;    // of any lidar, > 0
  int max_beam_count = 4096;     // of any scan
  double max_concentration_ppm = 1e6;
  int max_robot_count = 32;
  // A robot that is not heard of while the sample time moves on by this much counts as gone until
  // it is; [1, 1e9].
  double robot_silence_s = 60.0;
  // A robot that tells of less than this of a full battery is sent home, until it has 0.1 more than
  // this, or is full; [0, 1]; 0: none is.
  double return_home_below_battery_share = 0.0;
  // A pose farther than 5 m, and what the robot drives at this speed since, from its last one is
  // refused; [0, 1000]; 0: none is. Whoever registers again, or corrects its poses, begins anew.
  double max_robot_speed_mps = 20.0;
  // What the mission may come to hold, as reckoned by core/mission/memory_estimate.h;
  // [33554432 (32 MiB), 1e12]. Near it the gas lattice becomes coarser; what would go beyond is
  // refused with BUDGET_REACHED, and the map stays as it is.
  std::int64_t memory_budget_bytes = std::int64_t{512} << 20;
  // A sample whose clock runs too far ahead of the server's is taken with the time of its arrival
  // instead of being refused. Whoever runs the mission sees to it, for only they have a clock.
  bool stamp_by_arrival = false;
  // Whether scans and readings are kept, in up to a quarter of the budget, so that poses can be
  // corrected later (PoseCorrection) and robots that lose their place are told. False: neither.
  bool keep_scans = true;
  // Poses that were wrong by less than this do not mislead by the map that was made with them:
  // robots are judged by it before it is rebuilt. A radian counts as 3 m; [0, 10]; 0: all mislead.
  double misleading_move_m = 0.1;
  std::uint64_t seed = 1;
  // Where nobody may drive when the mission begins; see core/types/keep_out.h.
  std::vector<Polygon> keep_out;
  // At most 4, of different names; plans go by the first. None: one gas, without a name.
  std::vector<GasSpecies> gas_species;
  std::optional<Point2> home;  // of every robot, within pose_limit_m; none: its own first pose
  // What is known of the building before the first scan (see core/types/prior_map.h); null:
  // nothing.
  std::shared_ptr<const Grid<CellState>> prior_map;
};

// kInvalidArgument naming field, value and range: "gas.lattice_factor = 0 must be in [1, 16]".
absl::Status Validate(const OccupancyOptions& options);
absl::Status Validate(const GasOptions& options);
absl::Status Validate(const FrontierOptions& options);
absl::Status Validate(const PlanningOptions& options);
absl::Status Validate(const ObjectiveOptions& options);
absl::Status Validate(const MissionOptions& options);

// ln(32 lambda_p / lambda_d) / (4 pi lambda_p), ppm^2: the prior marginal variance on an open
// lattice, the unit in which variances are judged.
double OpenLatticeVariance_ppm2(const GasOptions& options);

}  // namespace plumescout
