// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/options.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/keep_out.h"
#include "core/types/prior_map.h"
#include "core/types/species.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// Limits of motion: a smaller one would make trajectories last for ever.
constexpr double kMinLimit = 1e-3;
constexpr double kMaxLimit = 100.0;
// A limit for the range check; 0, which stands for none, passes.
double LimitToCheck(double limit) { return limit == 0.0 ? kMaxLimit : limit; }

double LogOddsMagnitude(double probability) {
  return std::abs(std::log(probability / (1.0 - probability)));
}

constexpr double kBelowHalf = 0.499;
constexpr double kAboveHalf = 0.501;
constexpr double kMaxLogOdds = 50.0;       // a certainty of 1 - 2e-22
constexpr double kMaxWeight = 1e9;         // of a term of a cost: keeps costs finite, in float too
constexpr double kMaxResolution_m = 50.0;  // outdoors
constexpr double kMaxExtent_m =
    20'000.0;  // six tiles of such cells; max_cell_count bounds the memory
constexpr std::int64_t kMinBudget_bytes = std::int64_t{32} << 20;
constexpr std::int64_t kMaxBudget_bytes = 1'000'000'000'000;
constexpr double kMaxTime_s = 1e9;  // 30 years: added to a time in ns, it stays within int64

}  // namespace

absl::Status Validate(const OccupancyOptions& options) {
  // A tighter clamp would keep every cell short of a threshold, unknown for ever.
  const double least_clamp = std::max(LogOddsMagnitude(options.free_threshold_probability),
                                      LogOddsMagnitude(options.occupied_threshold_probability));
  return Checker()
      .InRange("occupancy.resolution_m", options.resolution_m, 0.01, kMaxResolution_m)
      .InRange("occupancy.inflation_radius_m", options.inflation_radius_m, 0.0, 5.0)
      .InRange("occupancy.free_threshold_probability", options.free_threshold_probability, 0.001,
               kBelowHalf)
      .InRange("occupancy.occupied_threshold_probability", options.occupied_threshold_probability,
               kAboveHalf, 0.999)
      .Positive("occupancy.hit_log_odds", options.hit_log_odds)
      .Negative("occupancy.miss_log_odds", options.miss_log_odds)
      .InRange("occupancy.hit_log_odds", options.hit_log_odds, 0.0, kMaxLogOdds)
      .InRange("occupancy.miss_log_odds", options.miss_log_odds, -kMaxLogOdds, 0.0)
      .InRange("occupancy.clamp_log_odds", options.clamp_log_odds, least_clamp, kMaxLogOdds)
      .InRange("occupancy.max_extent_m", options.max_extent_m, 1.0, kMaxExtent_m)
      .InRange("occupancy.max_cell_count", options.max_cell_count, 4096, 16'000'000)
      .InRange("occupancy.surface_depth_m", options.surface_depth_m, 0.0, 1.0)
      .status();
}

absl::Status Validate(const GasOptions& options) {
  constexpr double kMaxPrecision = 1e9;
  constexpr double kMinPrecision = 1e-9;
  constexpr double kMinHalfLife_s = 1e-3;  // keeps the variance of old readings finite
  const bool ages = options.ageing_half_life_s != 0.0;
  return Checker()
      .InRange("gas.prior_precision_per_ppm2", options.prior_precision_per_ppm2, kMinPrecision,
               kMaxPrecision)
      .InRange("gas.observation_precision_per_ppm2", options.observation_precision_per_ppm2,
               kMinPrecision, kMaxPrecision)
      .InRange("gas.background_precision_per_ppm2", options.background_precision_per_ppm2,
               kMinPrecision, kMaxPrecision)
      .InRange("gas.background_mean_ppm", options.background_mean_ppm, 0.0, 1e6)
      .InRange("gas.observation_stddev_share", options.observation_stddev_share, 0.0, 10.0)
      .InRange("gas.ageing_half_life_s", ages ? options.ageing_half_life_s : kMaxTime_s,
               kMinHalfLife_s, kMaxTime_s)
      .InRange("gas.lattice_factor", options.lattice_factor, 1, kMostLatticeFactor)
      .InRange("gas.field_reach_m", options.field_reach_m, 0.0, 1e6)
      .InRange("gas.unread_discount_ratio", options.unread_discount_ratio, 0.0, 10.0)
      .InRange("gas.gust_ratio", options.gust_ratio, 0.0, 1.0)
      .InRange("gas.refresh_period_s", options.refresh_period_s, 0.01, 3600.0)
      .InRange("gas.audit_period_epochs", options.audit_period_epochs, 0, 1'000'000)
      .Require(options.estimate_noise || options.precisions == GasPrecisions::kFixed,
               "gas.estimate_noise", options.estimate_noise ? 1.0 : 0.0,
               "must be true where gas.precisions are learned")
      .status();
}

absl::Status Validate(const FrontierOptions& options) {
  return Checker()
      .InRange("frontier.min_occupancy_cell_count", options.min_occupancy_cell_count, 1, 1e6)
      .InRange("frontier.min_gas_cell_count", options.min_gas_cell_count, 1, 1e6)
      .InRange("frontier.observed_variance_ratio", options.observed_variance_ratio, 1e-6, 10.0)
      .Positive("frontier.observed_variance_ppm2", options.observed_variance_ppm2.value_or(1.0))
      .InRange("frontier.gas_percentile", options.gas_percentile, 0.0, 100.0)
      .Positive("frontier.min_gas_threshold_ppm", options.min_gas_threshold_ppm)
      .Positive("frontier.fixed_gas_threshold_ppm", options.fixed_gas_threshold_ppm.value_or(1.0))
      .status();
}

namespace {

absl::Status Validate(const Rectangle& region) {
  constexpr double kMaxCoordinate_m = 1e6;
  return Checker()
      .InRange("planning.sites.region.min.x_m", region.min.x_m, -kMaxCoordinate_m, kMaxCoordinate_m)
      .InRange("planning.sites.region.min.y_m", region.min.y_m, -kMaxCoordinate_m, kMaxCoordinate_m)
      .InRange("planning.sites.region.max.x_m", region.max.x_m, region.min.x_m, kMaxCoordinate_m)
      .InRange("planning.sites.region.max.y_m", region.max.y_m, region.min.y_m, kMaxCoordinate_m)
      .status();
}

absl::Status Validate(const SiteOptions& options) {
  constexpr double kMaxStride = 1000;
  constexpr double kMaxCandidates = 16;  // 2^M subsets of them are priced
  if (options.region) PLUMESCOUT_RETURN_IF_ERROR(Validate(*options.region));
  return Checker()
      .InRange("planning.sites.spacing_m", options.spacing_m, 0.05, 1000.0)
      .InRange("planning.sites.survey_stride", options.survey_stride, 1, kMaxStride)
      .InRange("planning.sites.candidate_count", options.candidate_count, 1, kMaxCandidates)
      .InRange("planning.sites.cycle_sample_count", options.cycle_sample_count, 1,
               options.candidate_count)
      .InRange("planning.sites.update_period_s", options.update_period_s, 1e-3, 1e6)
      .InRange("planning.sites.sweep_stride", options.sweep_stride, 1, kMaxStride)
      .InRange("planning.sites.sweep_leg_stride", options.sweep_leg_stride, 1, kMaxStride)
      .status();
}

}  // namespace

absl::Status Validate(const PlanningOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options.sites));
  return Checker()
      .InRange("planning.max_goal_count", options.max_goal_count, 1, 1000)
      .InRange("planning.min_goal_distance_m", options.min_goal_distance_m, 0.0, 100.0)
      .InRange("planning.alpha_per_m", options.alpha_per_m, 0.0, kMaxWeight)
      .InRange("planning.beta", options.beta, 0.0, kMaxWeight)
      .InRange("planning.sample_count", options.sample_count, 1, 100'000)
      .InRange("planning.nearest_sample_count", options.nearest_sample_count, 1, 100)
      .InRange("planning.uniform_share", options.uniform_share, 0.0, 1.0)
      .InRange("planning.radius_factor", options.radius_factor, 0.01, 100.0)
      .InRange("planning.max_connection_radius_m", options.max_connection_radius_m, 0.0, 1000.0)
      .InRange("planning.reading_rate_hz", options.reading_rate_hz, 0.01, 1000.0)
      .InRange("planning.unseen_information_nats", options.unseen_information_nats, 0.0, kMaxWeight)
      .InRange("planning.commitment_margin_share", options.commitment_margin_share, 0.0, 1.0)
      .InRange("planning.speed_mps", options.speed_mps, 0.001, 100.0)
      .InRange("planning.dwell_s", options.dwell_s, 0.0, 3600.0)
      .Positive("planning.set_aside_s", options.set_aside_s)
      .InRange("planning.set_aside_s", options.set_aside_s, 0.0, kMaxTime_s)
      .InRange("planning.fallback_limit", options.fallback_limit, 1, 1000)
      .InRange("planning.max_acceleration_mps2", LimitToCheck(options.max_acceleration_mps2),
               kMinLimit, kMaxLimit)
      .InRange("planning.max_turn_rate_rad_per_s", LimitToCheck(options.max_turn_rate_rad_per_s),
               kMinLimit, kMaxLimit)
      .InRange("planning.travel_budget_m", options.travel_budget_m, 0.0, 1e9)
      .InRange("planning.return_margin_share", options.return_margin_share, 0.0, 10.0)
      .InRange("planning.robot_clearance_m", options.robot_clearance_m, 0.0, 10.0)
      .InRange("planning.team_replan_period_s", options.team_replan_period_s, 0.0, 3600.0)
      .InRange("planning.planning_latency_s", options.planning_latency_s, 0.0, 60.0)
      .status();
}

absl::Status Validate(const ObjectiveOptions& options) {
  constexpr double kMaxThreshold_ppm = 1e6;
  constexpr double kMaxRadius_m = 100.0;
  return Checker()
      .InRange("objective.threshold_ppm", options.threshold_ppm, 0.0, kMaxThreshold_ppm)
      .Require(options.kind == ObjectiveKind::kCompleteMap || options.threshold_ppm > 0.0,
               "objective.threshold_ppm", options.threshold_ppm,
               "must be > 0 for any objective.kind but a complete map")
      .InRange("objective.confidence", options.confidence, 0.501, 0.9999)
      .InRange("objective.radius_m", options.radius_m, 0.0, kMaxRadius_m)
      .InRange("objective.deadline_s", options.deadline_s, 0.0, kMaxTime_s)
      .InRange("objective.hold_s", options.hold_s, 0.0, 3600.0)
      .status();
}

absl::Status Validate(const MissionOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options.occupancy));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options.gas));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options.frontier));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options.planning));
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options.objective));
  PLUMESCOUT_RETURN_IF_ERROR(ValidateKeepOut(options.keep_out));
  PLUMESCOUT_RETURN_IF_ERROR(ValidateSpecies(options));
  if (options.prior_map != nullptr) {
    PLUMESCOUT_RETURN_IF_ERROR(ValidatePriorMap(*options.prior_map, options.occupancy));
  }
  const Point2 home = options.home.value_or(Point2{});
  return Checker()
      .InRange("pose_limit_m", options.pose_limit_m, 1.0, 1e6)
      .InRange("max_range_m", options.max_range_m, 0.1, 1000.0)
      .InRange("max_beam_count", options.max_beam_count, 1, 100'000)
      .InRange("max_concentration_ppm", options.max_concentration_ppm, 1.0, 1e6)
      .InRange("max_robot_count", options.max_robot_count, 1, 1000)
      .InRange("robot_silence_s", options.robot_silence_s, 1.0, 1e9)
      .InRange("return_home_below_battery_share", options.return_home_below_battery_share, 0.0, 1.0)
      .InRange("max_robot_speed_mps", options.max_robot_speed_mps, 0.0, 1000.0)
      .InRange("misleading_move_m", options.misleading_move_m, 0.0, 10.0)
      .InRange("memory_budget_bytes", options.memory_budget_bytes, kMinBudget_bytes,
               kMaxBudget_bytes)
      .InRange("home.x_m", home.x_m, -options.pose_limit_m, options.pose_limit_m)
      .InRange("home.y_m", home.y_m, -options.pose_limit_m, options.pose_limit_m)
      .status();
}

OccupancyOptions PublishedOccupancyOptions() {
  OccupancyOptions occupancy;
  occupancy.surface_depth_m = 0.0;
  return occupancy;
}

GasOptions PublishedGasOptions() {
  GasOptions gas;
  gas.observation_precision_per_ppm2 = 10.0;
  gas.background_precision_per_ppm2 = 0.001;
  gas.background_by_area = false;
  gas.noise_by_level = false;
  gas.unread_discount_ratio = 0.0;
  gas.gust_ratio = 0.0;
  return gas;
}

double OpenLatticeVariance_ppm2(const GasOptions& options) {
  constexpr double kPi = 3.14159265358979323846;
  return std::log(32.0 * options.prior_precision_per_ppm2 / options.background_precision_per_ppm2) /
         (4.0 * kPi * options.prior_precision_per_ppm2);
}

}  // namespace plumescout
