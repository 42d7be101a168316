// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/options.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/types/status_macros.h"
#include "google/protobuf/message.h"
#include "google/protobuf/util/message_differencer.h"
#include "proto/convert/enums.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"
#include "proto/convert/prior_map.h"

namespace plumescout {
namespace {

// The helpers below overload these rather than hide them.
using plumescout::FromProto;
using plumescout::ToProto;

constexpr std::size_t kMaxStrategyName = 64;

v1::OccupancyOptions ToProto(const OccupancyOptions& options) {
  v1::OccupancyOptions proto;
  proto.set_resolution_m(options.resolution_m);
  proto.set_inflation_radius_m(options.inflation_radius_m);
  proto.set_free_threshold_probability(options.free_threshold);
  proto.set_occupied_threshold_probability(options.occupied_threshold);
  proto.set_hit_log_odds(options.hit_log_odds);
  proto.set_miss_log_odds(options.miss_log_odds);
  proto.set_clamp_log_odds(options.clamp_log_odds);
  proto.set_max_extent_m(options.max_extent_m);
  proto.set_max_cell_count(options.max_cells);
  return proto;
}

v1::GasOptions ToProto(const GasOptions& options) {
  v1::GasOptions proto;
  proto.set_prior_precision_per_ppm2(options.prior_precision);
  proto.set_observation_precision_per_ppm2(options.observation_precision);
  proto.set_background_precision_per_ppm2(options.background_precision);
  proto.set_background_mean_ppm(options.background_mean_ppm);
  proto.set_ageing_half_life_s(options.ageing_half_life_s);
  proto.set_refresh_period_s(options.refresh_period_s);
  proto.set_lattice_factor(options.lattice_factor);
  proto.set_observation_stddev_share(options.observation_relative_stddev);
  return proto;
}

v1::FrontierOptions ToProto(const FrontierOptions& options) {
  v1::FrontierOptions proto;
  proto.set_min_occupancy_cell_count(options.min_occupancy_cells);
  proto.set_min_gas_cell_count(options.min_gas_cells);
  proto.set_observed_variance_ratio(options.observed_variance_ratio);
  if (options.observed_variance_ppm2.has_value()) {
    proto.set_observed_variance_ppm2(*options.observed_variance_ppm2);
  }
  proto.set_gas_percentile(options.gas_percentile);
  proto.set_min_gas_threshold_ppm(options.min_gas_threshold_ppm);
  if (options.fixed_gas_threshold_ppm.has_value()) {
    proto.set_fixed_gas_threshold_ppm(*options.fixed_gas_threshold_ppm);
  }
  proto.set_wgfd_scope(ToProto(options.wgfd_scope));
  return proto;
}

v1::SiteOptions ToProto(const SiteOptions& options) {
  v1::SiteOptions proto;
  if (options.region) {
    *proto.mutable_region()->mutable_min() = ToProto(options.region->min);
    *proto.mutable_region()->mutable_max() = ToProto(options.region->max);
  }
  proto.set_spacing_m(options.spacing_m);
  proto.set_reward(ToProto(options.reward));
  proto.set_survey(options.survey);
  proto.set_survey_stride(options.survey_stride);
  proto.set_candidate_count(options.candidates);
  proto.set_cycle_sample_count(options.cycle_samples);
  proto.set_update_period_s(options.update_period_s);
  proto.set_sweep_stride(options.sweep_stride);
  proto.set_sweep_leg_stride(options.sweep_leg_stride);
  return proto;
}

v1::PlanningOptions ToProto(const PlanningOptions& options) {
  v1::PlanningOptions proto;
  proto.set_strategy(options.strategy);
  proto.set_goal_policy(ToProto(options.goals));
  proto.set_draw_goals(options.draw_goals);
  proto.set_max_goal_count(options.max_goals);
  proto.set_min_goal_distance_m(options.min_goal_distance_m);
  proto.set_cost(ToProto(options.cost));
  proto.set_selection_cost(ToProto(options.selection_cost));
  proto.set_selection_rule(ToProto(options.selection));
  proto.set_alpha_per_m(options.alpha);
  proto.set_beta(options.beta);
  proto.set_raw_variance(options.raw_variance);
  proto.set_sample_count(options.samples);
  proto.set_nearest_sample_count(options.nearest_samples);
  proto.set_uniform_share(options.uniform_share);
  proto.set_sampling(ToProto(options.sampling));
  proto.set_radius_factor(options.radius_factor);
  proto.set_mixture_radius(options.mixture_radius);
  proto.set_grid_guard(options.grid_guard);
  proto.set_speed_mps(options.speed_mps);
  proto.set_dwell_s(options.dwell_s);
  proto.set_set_aside_s(options.set_aside_s);
  proto.set_fallback_limit(options.fallback_limit);
  proto.set_fallback_to_unobserved(options.fallback_to_unobserved);
  proto.set_paths(ToProto(options.paths));
  proto.set_goal_vertices(options.goal_vertices);
  proto.set_informed_heuristic(options.informed_heuristic);
  proto.set_straighten(options.straighten);
  proto.set_reading_rate_hz(options.reading_rate_hz);
  proto.set_commitment_margin_share(options.commitment_margin);
  proto.set_max_acceleration_mps2(options.max_acceleration_mps2);
  proto.set_max_turn_rate_rad_per_s(options.max_turn_rate_rad_per_s);
  proto.set_travel_budget_m(options.travel_budget_m);
  proto.set_return_margin_share(options.return_margin_share);
  proto.set_return_home(options.return_home);
  proto.set_planning_latency_s(options.planning_latency_s);
  *proto.mutable_sites() = ToProto(options.sites);
  proto.set_max_connection_radius_m(options.max_connection_radius_m);
  proto.set_unseen_information_nats(options.unseen_information_nats);
  return proto;
}

template <typename From, typename To>
void Take(bool set, const From& from, To& to) {
  if (set) to = static_cast<To>(from);
}

template <typename Proto, typename Core>
absl::Status TakeEnum(Proto proto, const std::string& field, Core& core) {
  if (static_cast<int>(proto) == 0) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(core, FromProto(proto, field));
  return absl::OkStatus();
}

void Read(const v1::OccupancyOptions& proto, OccupancyOptions& options) {
  Take(proto.has_resolution_m(), proto.resolution_m(), options.resolution_m);
  Take(proto.has_inflation_radius_m(), proto.inflation_radius_m(), options.inflation_radius_m);
  Take(proto.has_free_threshold_probability(), proto.free_threshold_probability(),
       options.free_threshold);
  Take(proto.has_occupied_threshold_probability(), proto.occupied_threshold_probability(),
       options.occupied_threshold);
  Take(proto.has_hit_log_odds(), proto.hit_log_odds(), options.hit_log_odds);
  Take(proto.has_miss_log_odds(), proto.miss_log_odds(), options.miss_log_odds);
  Take(proto.has_clamp_log_odds(), proto.clamp_log_odds(), options.clamp_log_odds);
  Take(proto.has_max_extent_m(), proto.max_extent_m(), options.max_extent_m);
  Take(proto.has_max_cell_count(), proto.max_cell_count(), options.max_cells);
}

void Read(const v1::GasOptions& proto, GasOptions& options) {
  Take(proto.has_prior_precision_per_ppm2(), proto.prior_precision_per_ppm2(),
       options.prior_precision);
  Take(proto.has_observation_precision_per_ppm2(), proto.observation_precision_per_ppm2(),
       options.observation_precision);
  Take(proto.has_background_precision_per_ppm2(), proto.background_precision_per_ppm2(),
       options.background_precision);
  Take(proto.has_background_mean_ppm(), proto.background_mean_ppm(), options.background_mean_ppm);
  Take(proto.has_ageing_half_life_s(), proto.ageing_half_life_s(), options.ageing_half_life_s);
  Take(proto.has_refresh_period_s(), proto.refresh_period_s(), options.refresh_period_s);
  Take(proto.has_lattice_factor(), proto.lattice_factor(), options.lattice_factor);
  Take(proto.has_observation_stddev_share(), proto.observation_stddev_share(),
       options.observation_relative_stddev);
}

absl::Status Read(const v1::FrontierOptions& proto, absl::string_view field,
                  FrontierOptions& options) {
  Take(proto.has_min_occupancy_cell_count(), proto.min_occupancy_cell_count(),
       options.min_occupancy_cells);
  Take(proto.has_min_gas_cell_count(), proto.min_gas_cell_count(), options.min_gas_cells);
  Take(proto.has_observed_variance_ratio(), proto.observed_variance_ratio(),
       options.observed_variance_ratio);
  Take(proto.has_observed_variance_ppm2(), proto.observed_variance_ppm2(),
       options.observed_variance_ppm2);
  Take(proto.has_gas_percentile(), proto.gas_percentile(), options.gas_percentile);
  Take(proto.has_min_gas_threshold_ppm(), proto.min_gas_threshold_ppm(),
       options.min_gas_threshold_ppm);
  Take(proto.has_fixed_gas_threshold_ppm(), proto.fixed_gas_threshold_ppm(),
       options.fixed_gas_threshold_ppm);
  return TakeEnum(proto.wgfd_scope(), Join(field, "wgfd_scope"), options.wgfd_scope);
}

absl::Status ReadChoices(const v1::PlanningOptions& proto, absl::string_view field,
                         PlanningOptions& options) {
  if (proto.strategy().size() > kMaxStrategyName) {
    return FieldError(Join(field, "strategy"), proto.strategy(), "is longer than 64 bytes");
  }
  Take(proto.has_strategy(), proto.strategy(), options.strategy);
  PLUMESCOUT_RETURN_IF_ERROR(
      TakeEnum(proto.goal_policy(), Join(field, "goal_policy"), options.goals));
  PLUMESCOUT_RETURN_IF_ERROR(TakeEnum(proto.paths(), Join(field, "paths"), options.paths));
  PLUMESCOUT_RETURN_IF_ERROR(TakeEnum(proto.cost(), Join(field, "cost"), options.cost));
  PLUMESCOUT_RETURN_IF_ERROR(
      TakeEnum(proto.selection_cost(), Join(field, "selection_cost"), options.selection_cost));
  PLUMESCOUT_RETURN_IF_ERROR(
      TakeEnum(proto.selection_rule(), Join(field, "selection_rule"), options.selection));
  return TakeEnum(proto.sampling(), Join(field, "sampling"), options.sampling);
}

void ReadNumbers(const v1::PlanningOptions& proto, PlanningOptions& options) {
  Take(proto.has_draw_goals(), proto.draw_goals(), options.draw_goals);
  Take(proto.has_max_goal_count(), proto.max_goal_count(), options.max_goals);
  Take(proto.has_min_goal_distance_m(), proto.min_goal_distance_m(), options.min_goal_distance_m);
  Take(proto.has_alpha_per_m(), proto.alpha_per_m(), options.alpha);
  Take(proto.has_beta(), proto.beta(), options.beta);
  Take(proto.has_raw_variance(), proto.raw_variance(), options.raw_variance);
  Take(proto.has_sample_count(), proto.sample_count(), options.samples);
  Take(proto.has_nearest_sample_count(), proto.nearest_sample_count(), options.nearest_samples);
  Take(proto.has_uniform_share(), proto.uniform_share(), options.uniform_share);
  Take(proto.has_radius_factor(), proto.radius_factor(), options.radius_factor);
  Take(proto.has_mixture_radius(), proto.mixture_radius(), options.mixture_radius);
  Take(proto.has_grid_guard(), proto.grid_guard(), options.grid_guard);
  Take(proto.has_speed_mps(), proto.speed_mps(), options.speed_mps);
  Take(proto.has_dwell_s(), proto.dwell_s(), options.dwell_s);
  Take(proto.has_set_aside_s(), proto.set_aside_s(), options.set_aside_s);
  Take(proto.has_fallback_limit(), proto.fallback_limit(), options.fallback_limit);
  Take(proto.has_fallback_to_unobserved(), proto.fallback_to_unobserved(),
       options.fallback_to_unobserved);
  Take(proto.has_goal_vertices(), proto.goal_vertices(), options.goal_vertices);
  Take(proto.has_informed_heuristic(), proto.informed_heuristic(), options.informed_heuristic);
  Take(proto.has_straighten(), proto.straighten(), options.straighten);
  Take(proto.has_reading_rate_hz(), proto.reading_rate_hz(), options.reading_rate_hz);
  Take(proto.has_commitment_margin_share(), proto.commitment_margin_share(),
       options.commitment_margin);
  Take(proto.has_max_connection_radius_m(), proto.max_connection_radius_m(),
       options.max_connection_radius_m);
  Take(proto.has_unseen_information_nats(), proto.unseen_information_nats(),
       options.unseen_information_nats);
}

void ReadMotion(const v1::PlanningOptions& proto, PlanningOptions& options) {
  Take(proto.has_max_acceleration_mps2(), proto.max_acceleration_mps2(),
       options.max_acceleration_mps2);
  Take(proto.has_max_turn_rate_rad_per_s(), proto.max_turn_rate_rad_per_s(),
       options.max_turn_rate_rad_per_s);
  Take(proto.has_travel_budget_m(), proto.travel_budget_m(), options.travel_budget_m);
  Take(proto.has_return_margin_share(), proto.return_margin_share(), options.return_margin_share);
  Take(proto.has_return_home(), proto.return_home(), options.return_home);
  Take(proto.has_planning_latency_s(), proto.planning_latency_s(), options.planning_latency_s);
}

absl::Status Read(const v1::SiteOptions& proto, absl::string_view field, SiteOptions& options) {
  if (proto.has_region()) {
    const std::string region = Join(field, "region");
    PLUMESCOUT_RETURN_IF_ERROR(CheckPresent(Join(region, "min"), proto.region().has_min()));
    PLUMESCOUT_ASSIGN_OR_RETURN(const Point2 min,
                                FromProto(proto.region().min(), Join(region, "min")));
    PLUMESCOUT_RETURN_IF_ERROR(CheckPresent(Join(region, "max"), proto.region().has_max()));
    PLUMESCOUT_ASSIGN_OR_RETURN(const Point2 max,
                                FromProto(proto.region().max(), Join(region, "max")));
    options.region = Rectangle{min, max};
  }
  Take(proto.has_spacing_m(), proto.spacing_m(), options.spacing_m);
  Take(proto.has_survey(), proto.survey(), options.survey);
  Take(proto.has_survey_stride(), proto.survey_stride(), options.survey_stride);
  Take(proto.has_candidate_count(), proto.candidate_count(), options.candidates);
  Take(proto.has_cycle_sample_count(), proto.cycle_sample_count(), options.cycle_samples);
  Take(proto.has_update_period_s(), proto.update_period_s(), options.update_period_s);
  Take(proto.has_sweep_stride(), proto.sweep_stride(), options.sweep_stride);
  Take(proto.has_sweep_leg_stride(), proto.sweep_leg_stride(), options.sweep_leg_stride);
  return TakeEnum(proto.reward(), Join(field, "reward"), options.reward);
}

// A mission's own areas take the place of the defaults, not a place among them.
absl::Status ReadPlaces(const v1::MissionOptions& proto, absl::string_view field,
                        MissionOptions& options) {
  if (proto.keep_out_size() > 0) options.keep_out.clear();
  for (int i = 0; i < proto.keep_out_size(); ++i) {
    const std::string area = Join(field, "keep_out", i);
    Polygon polygon;
    for (int k = 0; k < proto.keep_out(i).vertices_size(); ++k) {
      PLUMESCOUT_ASSIGN_OR_RETURN(
          const Point2 vertex, FromProto(proto.keep_out(i).vertices(k), Join(area, "vertices", k)));
      polygon.vertices.push_back(vertex);
    }
    options.keep_out.push_back(std::move(polygon));
  }
  if (proto.has_home()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(options.home, FromProto(proto.home(), Join(field, "home")));
  }
  return absl::OkStatus();
}

absl::Status ReadPriorMap(const v1::PriorMap& proto, absl::string_view field,
                          MissionOptions& options) {
  if (proto.has_cells()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(Grid<CellState> map,
                                FromProto(proto.cells(), Join(field, "cells")));
    options.prior_map = std::make_shared<const Grid<CellState>>(std::move(map));
    return absl::OkStatus();
  }
  // Files are read before, by somebody who can; `options` has what they say.
  if (proto.has_files() && options.prior_map != nullptr) return absl::OkStatus();
  return FieldError(field, proto.has_files() ? "must come as cells here" : "must have a map");
}

// Clears the fields of `message` that are equal in `other`, a message of the same type.
void ClearEqualFields(const google::protobuf::Message& other, google::protobuf::Message& message) {
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  std::vector<const google::protobuf::FieldDescriptor*> fields;
  reflection.ListFields(message, &fields);
  google::protobuf::util::MessageDifferencer differencer;
  for (const auto* field : fields) {
    const bool is_part = field->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_MESSAGE &&
                         !field->is_repeated() && reflection.HasField(other, field);
    if (is_part) {
      google::protobuf::Message& part = *reflection.MutableMessage(&message, field);
      ClearEqualFields(reflection.GetMessage(other, field), part);
      if (part.ByteSizeLong() == 0) reflection.ClearField(&message, field);
    } else if (differencer.CompareWithFields(message, other, {field}, {field})) {
      reflection.ClearField(&message, field);
    }
  }
}

// Where Validate(options) calls a field differently from the wire.
constexpr FieldName kRenamed[] = {
    {"occupancy.free_threshold", "occupancy.free_threshold_probability"},
    {"occupancy.occupied_threshold", "occupancy.occupied_threshold_probability"},
    {"occupancy.max_cells", "occupancy.max_cell_count"},
    {"gas.prior_precision", "gas.prior_precision_per_ppm2"},
    {"gas.observation_precision", "gas.observation_precision_per_ppm2"},
    {"gas.background_precision", "gas.background_precision_per_ppm2"},
    {"gas.observation_relative_stddev", "gas.observation_stddev_share"},
    {"frontier.min_occupancy_cells", "frontier.min_occupancy_cell_count"},
    {"frontier.min_gas_cells", "frontier.min_gas_cell_count"},
    {"planning.max_goals", "planning.max_goal_count"},
    {"planning.alpha", "planning.alpha_per_m"},
    {"planning.samples", "planning.sample_count"},
    {"planning.commitment_margin", "planning.commitment_margin_share"},
    {"planning.nearest_samples", "planning.nearest_sample_count"},
    {"planning.sites.candidates", "planning.sites.candidate_count"},
    {"planning.sites.cycle_samples", "planning.sites.cycle_sample_count"},
    {"max_beams", "max_beam_count"},
    {"max_robots", "max_robot_count"},
};

}  // namespace

v1::MissionOptions ToProto(const MissionOptions& options) {
  v1::MissionOptions proto;
  *proto.mutable_occupancy() = ToProto(options.occupancy);
  *proto.mutable_gas() = ToProto(options.gas);
  *proto.mutable_frontier() = ToProto(options.frontier);
  *proto.mutable_planning() = ToProto(options.planning);
  proto.set_pose_limit_m(options.pose_limit_m);
  proto.set_max_range_m(options.max_range_m);
  proto.set_max_beam_count(options.max_beams);
  proto.set_max_concentration_ppm(options.max_concentration_ppm);
  proto.set_max_robot_count(options.max_robots);
  proto.set_seed(static_cast<std::int64_t>(options.seed));
  for (const Polygon& polygon : options.keep_out) {
    v1::Polygon& added = *proto.add_keep_out();
    for (const Point2 vertex : polygon.vertices) *added.add_vertices() = ToProto(vertex);
  }
  if (options.home) *proto.mutable_home() = ToProto(*options.home);
  if (options.prior_map) *proto.mutable_prior_map() = ToProto(*options.prior_map);
  return proto;
}

v1::MissionOptions ChangesToProto(const MissionOptions& options) {
  v1::MissionOptions proto = ToProto(options);
  ClearEqualFields(ToProto(MissionOptions{}), proto);
  return proto;
}

absl::StatusOr<MissionOptions> FromProto(const v1::MissionOptions& proto,
                                         const MissionOptions& defaults, absl::string_view field) {
  MissionOptions options = defaults;
  Read(proto.occupancy(), options.occupancy);
  Read(proto.gas(), options.gas);
  PLUMESCOUT_RETURN_IF_ERROR(Read(proto.frontier(), Join(field, "frontier"), options.frontier));
  PLUMESCOUT_RETURN_IF_ERROR(
      ReadChoices(proto.planning(), Join(field, "planning"), options.planning));
  ReadNumbers(proto.planning(), options.planning);
  ReadMotion(proto.planning(), options.planning);
  PLUMESCOUT_RETURN_IF_ERROR(
      Read(proto.planning().sites(), Join(field, "planning.sites"), options.planning.sites));
  Take(proto.has_pose_limit_m(), proto.pose_limit_m(), options.pose_limit_m);
  Take(proto.has_max_range_m(), proto.max_range_m(), options.max_range_m);
  Take(proto.has_max_beam_count(), proto.max_beam_count(), options.max_beams);
  Take(proto.has_max_concentration_ppm(), proto.max_concentration_ppm(),
       options.max_concentration_ppm);
  Take(proto.has_max_robot_count(), proto.max_robot_count(), options.max_robots);
  Take(proto.has_seed(), proto.seed(), options.seed);
  PLUMESCOUT_RETURN_IF_ERROR(ReadPlaces(proto, field, options));
  if (proto.has_prior_map()) {
    PLUMESCOUT_RETURN_IF_ERROR(ReadPriorMap(proto.prior_map(), Join(field, "prior_map"), options));
  }
  PLUMESCOUT_RETURN_IF_ERROR(WithField(Validate(options), field, kRenamed));
  return options;
}

}  // namespace plumescout
