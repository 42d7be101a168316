// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/strings/str_cat.h"
#include "plumescout/v1/mission_service.pb.h"
#include "tests/server/bad_input.h"
#include "tests/server/bad_keep_out_input.h"
#include "tests/server/bad_name_input.h"
#include "tests/server/bad_prior_map_input.h"
#include "tests/server/bad_site_input.h"
#include "tests/server/bad_species_input.h"

namespace plumescout::server {

inline BadInputs BadLimits() {
  return BadInputs()
      .Values("options.pose_limit_m", {"nan", "inf", "-1", "0", "1e7"})
      .Values("options.max_range_m", {"nan", "inf", "-1", "0", "1001"})
      .Values("options.max_beam_count", {"-1", "0", "100001"})
      .Values("options.max_concentration_ppm", {"nan", "inf", "-1", "0", "1e7"})
      .Values("options.max_robot_count", {"-1", "0", "1001"})
      .Values("options.robot_silence_s", {"nan", "inf", "-1", "0", "0.9", "1.1e9"})
      .Values("options.return_home_below_battery_share", {"nan", "inf", "-0.1", "1.1"})
      .Values("options.misleading_move_m", {"nan", "inf", "-0.1", "10.1"})
      .Values("options.max_robot_speed_mps", {"nan", "inf", "-1", "1001"})
      .Values("options.memory_budget_bytes", {"-1", "0", "33554431", "1073741825"});
}

inline BadInputs BadObjective() {
  const std::string o = "options.objective.";
  return BadInputs()
      .Values(o + "kind", {"-1", "99"})
      .Values(o + "threshold_ppm", {"nan", "inf", "-1", "1e7"})
      .Values(o + "confidence", {"nan", "inf", "-1", "0", "0.5", "1"})
      .Values(o + "radius_m", {"nan", "inf", "-1", "101"})
      .Values(o + "deadline_s", {"nan", "inf", "-1", "1.1e9"})
      .Values(o + "hold_s", {"nan", "inf", "-1", "3601"})
      .ValuesBlaming(o + "threshold_ppm", o + "kind", {"2", "3", "4"});
}

inline BadInputs BadPlaces() {
  return BadInputs()
      .Values("options.home.x_m", {"nan", "inf", "-1e300", "1001"})
      .Values("options.home.y_m", {"nan", "inf", "-1e300", "1001"})
      .Rows(BadAreas("options.keep_out"));
}

inline BadInputs BadOccupancyOptions() {
  const std::string o = "options.occupancy.";
  return BadInputs()
      .Values(o + "resolution_m", {"nan", "inf", "-inf", "-0.1", "0", "51"})
      .Values(o + "inflation_radius_m", {"nan", "inf", "-0.1", "6"})
      .Values(o + "free_threshold_probability", {"nan", "inf", "-1", "0", "0.5", "1"})
      .Values(o + "occupied_threshold_probability", {"nan", "inf", "-1", "0", "0.5", "1"})
      .Values(o + "hit_log_odds", {"nan", "inf", "-1", "0", "1e300"})
      .Values(o + "miss_log_odds", {"nan", "-inf", "1", "0", "-1e300"})
      .Values(o + "clamp_log_odds", {"nan", "inf", "-1", "0", "0.1", "51"})
      .Values(o + "max_extent_m", {"nan", "inf", "-1", "0", "20001"})
      .Values(o + "max_cell_count", {"-1", "0", "16000001", "9223372036854775807"})
      .Values(o + "surface_depth_m", {"nan", "inf", "-0.1", "1.1"});
}

inline BadInputs BadGasOptions() {
  const std::string g = "options.gas.";
  return BadInputs()
      .Values(g + "prior_precision_per_ppm2", {"nan", "inf", "-1", "0", "1e300", "1e-300"})
      .Values(g + "observation_precision_per_ppm2", {"nan", "inf", "-1", "0", "1e300", "1e-300"})
      .Values(g + "background_precision_per_ppm2", {"nan", "inf", "-1", "0", "1e300", "1e-300"})
      .Values(g + "background_mean_ppm", {"nan", "inf", "-1", "1e7"})
      .Values(g + "ageing_half_life_s", {"nan", "inf", "-1", "1e-300", "1e300"})
      .Values(g + "refresh_period_s", {"nan", "inf", "-1", "0", "1e5"})
      .Values(g + "audit_period_epochs", {"-1", "1000001"})
      .Values(g + "field_reach_m", {"nan", "inf", "-1", "1.1e6"})
      .Values(g + "observation_stddev_share", {"nan", "inf", "-0.1", "11"})
      .Values(g + "unread_discount_ratio", {"nan", "inf", "-0.1", "11"})
      .Values(g + "gust_ratio", {"nan", "inf", "-0.1", "1.1"})
      .Values(g + "scale", {"-1", "99"})
      .Values(g + "precisions", {"-1", "99"})
      .Values(g + "lattice_factor", {"-1", "0", "17"});
}

inline BadInputs BadFrontierOptions() {
  const std::string f = "options.frontier.";
  return BadInputs()
      .Values(f + "min_occupancy_cell_count", {"-1", "0", "2147483647"})
      .Values(f + "min_gas_cell_count", {"-1", "0", "2147483647"})
      .Values(f + "observed_variance_ratio", {"nan", "inf", "-1", "0", "11"})
      .Values(f + "observed_variance_ppm2", {"nan", "inf", "-1", "0"})
      .Values(f + "gas_percentile", {"nan", "inf", "-1", "101"})
      .Values(f + "min_gas_threshold_ppm", {"nan", "inf", "-1", "0"})
      .Values(f + "fixed_gas_threshold_ppm", {"nan", "inf", "-1", "0"})
      .Values(f + "wgfd_scope", {"-1", "99"});
}

inline BadInputs BadPlanningOptions() {
  const std::string p = "options.planning.";
  static const std::string too_long = absl::StrCat("\"", std::string(100'000, 'x'), "\"");
  return BadInputs()
      .Values(p + "strategy", {R"("")", R"("no_such")", R"("XIT_GFF")", too_long.c_str()})
      .Values(p + "goal_policy", {"-1", "99"})
      .Values(p + "max_goal_count", {"-1", "0", "1001"})
      .Values(p + "min_goal_distance_m", {"nan", "inf", "-1", "101"})
      .Values(p + "cost", {"-1", "99"})
      .Values(p + "selection_cost", {"-1", "99"})
      .Values(p + "selection_rule", {"-1", "99"})
      .Values(p + "alpha_per_m", {"nan", "inf", "-1", "1e300"})
      .Values(p + "beta", {"nan", "inf", "-1", "1e300"})
      .Values(p + "sample_count", {"-1", "0", "100001"})
      .Values(p + "nearest_sample_count", {"-1", "0", "101"})
      .Values(p + "uniform_share", {"nan", "inf", "-0.1", "1.1"})
      .Values(p + "sampling", {"-1", "99"})
      .Values(p + "radius_factor", {"nan", "inf", "-1", "0", "101"})
      .Values(p + "paths", {"-1", "99"})
      .Values(p + "reading_rate_hz", {"nan", "inf", "-1", "0", "1001"})
      .Values(p + "commitment_margin_share", {"nan", "inf", "-0.1", "1.1"})
      .Values(p + "robot_clearance_m", {"nan", "inf", "-0.1", "10.1"})
      .Values(p + "team_replan_period_s", {"nan", "inf", "-0.1", "3601"})
      .Values(p + "speed_mps", {"nan", "inf", "-1", "0", "101"})
      .Values(p + "dwell_s", {"nan", "inf", "-1", "3601"})
      .Values(p + "set_aside_s", {"nan", "inf", "-1", "0", "1e300"})
      .Values(p + "fallback_limit", {"-1", "0", "1001"})
      .Values(p + "max_acceleration_mps2", {"nan", "inf", "-1", "1e-300", "101"})
      .Values(p + "max_turn_rate_rad_per_s", {"nan", "inf", "-1", "1e-300", "101"})
      .Values(p + "travel_budget_m", {"nan", "inf", "-1", "1e300"})
      .Values(p + "return_margin_share", {"nan", "inf", "-0.1", "11"})
      .Values(p + "planning_latency_s", {"nan", "inf", "-1", "61"})
      .Values(p + "max_connection_radius_m", {"nan", "inf", "-1", "1001"})
      .Values(p + "unseen_information_nats", {"nan", "inf", "-1", "1e300"});
}

// The server has room for a mission of the default size, not for the largest.
inline BadInputs BadCreateMission() {
  return BadInputs()
      .Rows(BadId("mission_id"))
      .Rows(BadRequestId())
      .Rows(BadTimeToLive("idle_time_to_live"))
      .Values("event_retention", {"-1", "9"})
      .Value("mission_id", R"("hall")", absl::StatusCode::kAlreadyExists, "MISSION_EXISTS")
      .Rows(BadLimits())
      .Rows(BadPlaces())
      .Rows(BadObjective())
      .Rows(BadPriorMap())
      .Rows(BadGasSpecies())
      .Rows(BadOccupancyOptions())
      .Rows(BadGasOptions())
      .Rows(BadFrontierOptions())
      .Rows(BadPlanningOptions())
      .Rows(BadSiteOptions())
      .Row(
          {"options.memory_budget_bytes", "more than the server has left",
           [](Message& message) { SetField(message, "options.memory_budget_bytes", "1073741824"); },
           absl::StatusCode::kResourceExhausted, "LIMIT_REACHED"});
}

inline BadInputs BadListMissions() {
  return BadInputs()
      .Values("page_size", {"-1", "-2147483648"})
      .Values("page_token", {R"("hall")", R"("!")", R"("AAAA")"});
}

}  // namespace plumescout::server
