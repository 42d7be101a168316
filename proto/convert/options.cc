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
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"
#include "proto/convert/keep_out.h"
#include "proto/convert/option_binding.h"
#include "proto/convert/prior_map.h"

namespace plumescout {
namespace {

constexpr std::size_t kMaxStrategyName = 64;

void Visit(OneOf<OccupancyOptions> auto& options, auto& field) {
  field("resolution_m", options.resolution_m);
  field("inflation_radius_m", options.inflation_radius_m);
  field("free_threshold_probability", options.free_threshold_probability);
  field("occupied_threshold_probability", options.occupied_threshold_probability);
  field("hit_log_odds", options.hit_log_odds);
  field("miss_log_odds", options.miss_log_odds);
  field("clamp_log_odds", options.clamp_log_odds);
  field("max_extent_m", options.max_extent_m);
  field("max_cell_count", options.max_cell_count);
  field("surface_depth_m", options.surface_depth_m);
}

void Visit(OneOf<GasOptions> auto& options, auto& field) {
  field("prior_precision_per_ppm2", options.prior_precision_per_ppm2);
  field("observation_precision_per_ppm2", options.observation_precision_per_ppm2);
  field("background_precision_per_ppm2", options.background_precision_per_ppm2);
  field("background_mean_ppm", options.background_mean_ppm);
  field("ageing_half_life_s", options.ageing_half_life_s);
  field("refresh_period_s", options.refresh_period_s);
  field("audit_period_epochs", options.audit_period_epochs);
  field("lattice_factor", options.lattice_factor);
  field("observation_stddev_share", options.observation_stddev_share);
  field("field_reach_m", options.field_reach_m);
  field("scale", options.scale);
  field("estimate_noise", options.estimate_noise);
  field("noise_by_level", options.noise_by_level);
  field("precisions", options.precisions);
  field("unread_discount_ratio", options.unread_discount_ratio);
  field("gust_ratio", options.gust_ratio);
  field("background_by_area", options.background_by_area);
}

void Visit(OneOf<GasSpecies> auto& species, auto& field) {
  field("name", species.name);
  field("prior_precision_per_ppm2", species.prior_precision_per_ppm2);
  field("observation_precision_per_ppm2", species.observation_precision_per_ppm2);
  field("background_precision_per_ppm2", species.background_precision_per_ppm2);
  field("background_mean_ppm", species.background_mean_ppm);
}

void Visit(OneOf<FrontierOptions> auto& options, auto& field) {
  field("min_occupancy_cell_count", options.min_occupancy_cell_count);
  field("min_gas_cell_count", options.min_gas_cell_count);
  field("observed_variance_ratio", options.observed_variance_ratio);
  field("observed_variance_ppm2", options.observed_variance_ppm2);
  field("gas_percentile", options.gas_percentile);
  field("min_gas_threshold_ppm", options.min_gas_threshold_ppm);
  field("fixed_gas_threshold_ppm", options.fixed_gas_threshold_ppm);
  field("wgfd_scope", options.wgfd_scope);
}

void Visit(OneOf<SiteOptions> auto& options, auto& field) {
  field("spacing_m", options.spacing_m);
  field("reward", options.reward);
  field("survey", options.survey);
  field("survey_stride", options.survey_stride);
  field("candidate_count", options.candidate_count);
  field("cycle_sample_count", options.cycle_sample_count);
  field("update_period_s", options.update_period_s);
  field("sweep_stride", options.sweep_stride);
  field("sweep_leg_stride", options.sweep_leg_stride);
}

void VisitSearch(OneOf<PlanningOptions> auto& options, auto& field) {
  field("strategy", options.strategy);
  field("goal_policy", options.goal_policy);
  field("draw_goals", options.draw_goals);
  field("max_goal_count", options.max_goal_count);
  field("min_goal_distance_m", options.min_goal_distance_m);
  field("paths", options.paths);
  field("cost", options.cost);
  field("selection_cost", options.selection_cost);
  field("selection_rule", options.selection_rule);
  field("alpha_per_m", options.alpha_per_m);
  field("beta", options.beta);
  field("raw_variance", options.raw_variance);
  field("sample_count", options.sample_count);
  field("nearest_sample_count", options.nearest_sample_count);
  field("uniform_share", options.uniform_share);
  field("sampling", options.sampling);
  field("radius_factor", options.radius_factor);
  field("mixture_radius", options.mixture_radius);
  field("max_connection_radius_m", options.max_connection_radius_m);
  field("grid_guard", options.grid_guard);
  field("goal_vertices", options.goal_vertices);
  field("informed_heuristic", options.informed_heuristic);
  field("straighten", options.straighten);
  field("reading_rate_hz", options.reading_rate_hz);
  field("unseen_information_nats", options.unseen_information_nats);
  field("commitment_margin_share", options.commitment_margin_share);
}

void Visit(OneOf<PlanningOptions> auto& options, auto& field) {
  VisitSearch(options, field);
  field("speed_mps", options.speed_mps);
  field("dwell_s", options.dwell_s);
  field("set_aside_s", options.set_aside_s);
  field("fallback_to_unobserved", options.fallback_to_unobserved);
  field("fallback_limit", options.fallback_limit);
  field("yield_to_robots", options.yield_to_robots);
  field("robot_clearance_m", options.robot_clearance_m);
  field("anticipate_robots", options.anticipate_robots);
  field("balanced_areas", options.balanced_areas);
  field("team_replan_period_s", options.team_replan_period_s);
  field("max_acceleration_mps2", options.max_acceleration_mps2);
  field("max_turn_rate_rad_per_s", options.max_turn_rate_rad_per_s);
  field("travel_budget_m", options.travel_budget_m);
  field("return_margin_share", options.return_margin_share);
  field("return_home", options.return_home);
  field("planning_latency_s", options.planning_latency_s);
}

void Visit(OneOf<ObjectiveOptions> auto& options, auto& field) {
  field("kind", options.kind);
  field("threshold_ppm", options.threshold_ppm);
  field("confidence", options.confidence);
  field("radius_m", options.radius_m);
  field("deadline_s", options.deadline_s);
  field("hold_s", options.hold_s);
}

void Visit(OneOf<MissionOptions> auto& options, auto& field) {
  field("pose_limit_m", options.pose_limit_m);
  field("max_range_m", options.max_range_m);
  field("max_beam_count", options.max_beam_count);
  field("max_concentration_ppm", options.max_concentration_ppm);
  field("max_robot_count", options.max_robot_count);
  field("robot_silence_s", options.robot_silence_s);
  field("return_home_below_battery_share", options.return_home_below_battery_share);
  field("max_robot_speed_mps", options.max_robot_speed_mps);
  field("memory_budget_bytes", options.memory_budget_bytes);
  field("stamp_by_arrival", options.stamp_by_arrival);
  field("keep_scans", options.keep_scans);
  field("misleading_move_m", options.misleading_move_m);
  field("seed", options.seed);
}

void Write(const auto& options, google::protobuf::Message& proto) {
  OptionWriter field(proto);
  Visit(options, field);
}

absl::Status Read(const google::protobuf::Message& proto, absl::string_view path, auto& options) {
  OptionReader field(proto, path);
  Visit(options, field);
  return field.status();
}

absl::Status ReadRegion(const v1::Rectangle& proto, absl::string_view field, SiteOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckPresent(Join(field, "min"), proto.has_min()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Point2 min, FromProto(proto.min(), Join(field, "min")));
  PLUMESCOUT_RETURN_IF_ERROR(CheckPresent(Join(field, "max"), proto.has_max()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Point2 max, FromProto(proto.max(), Join(field, "max")));
  options.region = Rectangle{min, max};
  return absl::OkStatus();
}

absl::Status ReadPlanning(const v1::PlanningOptions& proto, absl::string_view field,
                          PlanningOptions& options) {
  if (proto.strategy().size() > kMaxStrategyName) {
    return FieldError(Join(field, "strategy"), proto.strategy(), "is longer than 64 bytes");
  }
  PLUMESCOUT_RETURN_IF_ERROR(Read(proto, field, options));
  const std::string sites = Join(field, "sites");
  if (proto.sites().has_region()) {
    PLUMESCOUT_RETURN_IF_ERROR(
        ReadRegion(proto.sites().region(), Join(sites, "region"), options.sites));
  }
  return Read(proto.sites(), sites, options.sites);
}

// A mission's own areas take the place of the defaults, not a place among them.
absl::Status ReadPlaces(const v1::MissionOptions& proto, absl::string_view field,
                        MissionOptions& options) {
  if (proto.keep_out_size() > 0) {
    PLUMESCOUT_ASSIGN_OR_RETURN(options.keep_out,
                                FromProto(proto.keep_out(), Join(field, "keep_out")));
  }
  if (proto.has_home()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(options.home, FromProto(proto.home(), Join(field, "home")));
  }
  return absl::OkStatus();
}

// As its own areas do, so do its gases.
absl::Status ReadSpecies(const v1::MissionOptions& proto, absl::string_view field,
                         MissionOptions& options) {
  if (proto.gas_species_size() > 0) options.gas_species.clear();
  for (int i = 0; i < proto.gas_species_size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(Read(proto.gas_species(i), Join(field, "gas_species", i),
                                    options.gas_species.emplace_back()));
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

}  // namespace

v1::MissionOptions ToProto(const MissionOptions& options) {
  v1::MissionOptions proto;
  Write(options, proto);
  Write(options.occupancy, *proto.mutable_occupancy());
  Write(options.gas, *proto.mutable_gas());
  Write(options.frontier, *proto.mutable_frontier());
  Write(options.planning, *proto.mutable_planning());
  v1::SiteOptions& sites = *proto.mutable_planning()->mutable_sites();
  Write(options.planning.sites, sites);
  if (options.planning.sites.region) {
    *sites.mutable_region()->mutable_min() = ToProto(options.planning.sites.region->min);
    *sites.mutable_region()->mutable_max() = ToProto(options.planning.sites.region->max);
  }
  Write(options.objective, *proto.mutable_objective());
  *proto.mutable_keep_out() = ToProto(options.keep_out);
  for (const GasSpecies& species : options.gas_species) Write(species, *proto.add_gas_species());
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
  PLUMESCOUT_RETURN_IF_ERROR(Read(proto.occupancy(), Join(field, "occupancy"), options.occupancy));
  PLUMESCOUT_RETURN_IF_ERROR(Read(proto.gas(), Join(field, "gas"), options.gas));
  PLUMESCOUT_RETURN_IF_ERROR(Read(proto.frontier(), Join(field, "frontier"), options.frontier));
  PLUMESCOUT_RETURN_IF_ERROR(
      ReadPlanning(proto.planning(), Join(field, "planning"), options.planning));
  PLUMESCOUT_RETURN_IF_ERROR(Read(proto.objective(), Join(field, "objective"), options.objective));
  PLUMESCOUT_RETURN_IF_ERROR(Read(proto, field, options));
  PLUMESCOUT_RETURN_IF_ERROR(ReadPlaces(proto, field, options));
  PLUMESCOUT_RETURN_IF_ERROR(ReadSpecies(proto, field, options));
  if (proto.has_prior_map()) {
    PLUMESCOUT_RETURN_IF_ERROR(ReadPriorMap(proto.prior_map(), Join(field, "prior_map"), options));
  }
  PLUMESCOUT_RETURN_IF_ERROR(WithField(Validate(options), field));
  return options;
}

MissionOptions RecordedDefaults() {
  MissionOptions options;
  options.keep_scans = false;
  options.misleading_move_m = 0.0;
  options.max_robot_speed_mps = 0.0;
  options.occupancy = PublishedOccupancyOptions();
  options.gas = PublishedGasOptions();
  options.gas.estimate_noise = false;
  options.objective.hold_s = 0.0;
  return options;
}

}  // namespace plumescout
