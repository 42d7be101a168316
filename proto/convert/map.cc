// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/map.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "core/types/species.h"
#include "core/types/status_macros.h"
#include "proto/convert/enums.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"
#include "proto/convert/keep_out.h"
#include "proto/convert/names.h"
#include "proto/convert/objective.h"
#include "proto/convert/sensor_offset.h"

namespace plumescout {
namespace {

// The helpers below overload these rather than hide them.
using plumescout::FromProto;
using plumescout::ToProto;

v1::Frontier ToProto(const Frontier& frontier) {
  v1::Frontier proto;
  proto.set_kind(ToProto(frontier.kind));
  for (const Cell cell : frontier.cells) {
    proto.add_cell_columns(cell.x);
    proto.add_cell_rows(cell.y);
  }
  *proto.mutable_centroid() = ToProto(frontier.centroid);
  *proto.mutable_goal_cell() = ToProto(frontier.goal_cell);
  proto.set_travel_m(frontier.reachable ? frontier.travel_m : 0.0);
  proto.set_reachable(frontier.reachable);
  proto.set_too_small(frontier.too_small);
  return proto;
}

v1::GasCounters ToProto(const GasCounters& counters) {
  v1::GasCounters proto;
  proto.set_reading_count(counters.readings);
  proto.set_in_posterior_count(counters.in_posterior);
  proto.set_moved_count(counters.moved_to_neighbour);
  proto.set_waiting_count(counters.waiting);
  return proto;
}

absl::StatusOr<Frontier> FromProto(const v1::Frontier& proto, absl::string_view field) {
  Frontier frontier;
  PLUMESCOUT_ASSIGN_OR_RETURN(frontier.kind,
                              FrontierKindFromProto(proto.kind(), Join(field, "kind")));
  if (proto.cell_columns_size() != proto.cell_rows_size()) {
    return FieldError(Join(field, "cell_rows"), "must be as many as cell_columns");
  }
  for (int i = 0; i < proto.cell_columns_size(); ++i) {
    frontier.cells.push_back({proto.cell_columns(i), proto.cell_rows(i)});
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(frontier.centroid,
                              FromProto(proto.centroid(), Join(field, "centroid")));
  frontier.goal_cell = FromProto(proto.goal_cell());
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "travel_m"), proto.travel_m()));
  frontier.travel_m = proto.travel_m();
  frontier.reachable = proto.reachable();
  frontier.too_small = proto.too_small();
  return frontier;
}

GasCounters FromProto(const v1::GasCounters& proto) {
  return {proto.reading_count(), proto.in_posterior_count(), proto.moved_count(),
          proto.waiting_count()};
}

absl::Status ReadLists(const v1::MapStatus& proto, absl::string_view field, MapStatus& map) {
  for (int i = 0; i < proto.frontiers_size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(Frontier frontier,
                                FromProto(proto.frontiers(i), Join(field, "frontiers", i)));
    map.frontiers.push_back(std::move(frontier));
  }
  for (int i = 0; i < proto.robots_size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(RobotState robot,
                                FromProto(proto.robots(i), Join(field, "robots", i)));
    map.robots.push_back(std::move(robot));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(map.keep_out, FromProto(proto.keep_out(), Join(field, "keep_out")));
  return absl::OkStatus();
}

absl::Status ReadCompleteness(const v1::MapStatus& proto, absl::string_view field,
                              Completeness& completeness) {
  completeness = {.reachable_area_m2 = proto.reachable_area_m2(),
                  .observed_area_m2 = proto.observed_area_m2()};
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckNotNegative(Join(field, "reachable_area_m2"), completeness.reachable_area_m2));
  return CheckNotNegative(Join(field, "observed_area_m2"), completeness.observed_area_m2);
}

absl::Status ReadLayers(const google::protobuf::RepeatedField<int>& layers, MapView& view) {
  if (layers.empty()) return absl::OkStatus();
  view.occupancy = view.gas_mean = view.gas_variance = false;
  for (int i = 0; i < layers.size(); ++i) {
    switch (layers[i]) {
      case v1::MAP_LAYER_OCCUPANCY:
        view.occupancy = true;
        break;
      case v1::MAP_LAYER_GAS_MEAN:
        view.gas_mean = true;
        break;
      case v1::MAP_LAYER_GAS_VARIANCE:
        view.gas_variance = true;
        break;
      default:
        return FieldError(Join("", "layers", i), layers[i], "is not a layer");
    }
  }
  return absl::OkStatus();
}

absl::StatusOr<Rectangle> FromProto(const v1::MapRegion& proto, absl::string_view field) {
  const std::string max_field = Join(field, "max");
  PLUMESCOUT_RETURN_IF_ERROR(CheckPresent(Join(field, "min"), proto.has_min()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckPresent(max_field, proto.has_max()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Point2 min, FromProto(proto.min(), Join(field, "min")));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Point2 max, FromProto(proto.max(), max_field));
  constexpr absl::string_view kRule = "must not be less than that of min";
  if (max.x_m < min.x_m) return FieldError(Join(max_field, "x_m"), max.x_m, kRule);
  if (max.y_m < min.y_m) return FieldError(Join(max_field, "y_m"), max.y_m, kRule);
  return Rectangle{min, max};
}

// A tile of another gas than the first.
absl::Status DecodeFurther(const v1::MapTile& tile, absl::string_view field, MapSnapshot& map) {
  std::vector<GasLayers>& gases = map.further_gases;
  auto found = std::find_if(gases.begin(), gases.end(),
                            [&](const GasLayers& gas) { return gas.species == tile.species(); });
  if (found == gases.end()) {
    if (gases.size() + 1 >= kMostSpecies) {
      return FieldError(Join(field, "species"), tile.species(), "is one gas too many");
    }
    const Grid<float> nothing(map.occupancy.geometry(), std::numeric_limits<float>::quiet_NaN());
    found = gases.insert(gases.end(), {tile.species(), nothing, nothing});
  }
  switch (tile.layer()) {
    case v1::MAP_LAYER_GAS_MEAN:
      return DecodeValues(tile, field, found->mean_ppm);
    case v1::MAP_LAYER_GAS_VARIANCE:
      return DecodeValues(tile, field, found->variance_ppm2);
    default:
      return FieldError(Join(field, "layer"), tile.layer(), "is not a gas layer");
  }
}

template <typename Request>
absl::StatusOr<MapView> ReadView(const Request& request) {
  MapView view;
  PLUMESCOUT_RETURN_IF_ERROR(ReadLayers(request.layers(), view));
  view.full_precision = request.full_precision();
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange("level_of_detail", request.level_of_detail(), 0, kMaxLevelOfDetail));
  view.level_of_detail = request.level_of_detail();
  if (request.has_region()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(view.region, FromProto(request.region(), "region"));
  }
  view.species = {request.species().begin(), request.species().end()};
  return view;
}

template <typename Request>
void WriteView(const MapView& view, Request& request) {
  if (view.occupancy) request.add_layers(v1::MAP_LAYER_OCCUPANCY);
  if (view.gas_mean) request.add_layers(v1::MAP_LAYER_GAS_MEAN);
  if (view.gas_variance) request.add_layers(v1::MAP_LAYER_GAS_VARIANCE);
  request.set_full_precision(view.full_precision);
  request.set_level_of_detail(view.level_of_detail);
  if (view.region) {
    *request.mutable_region()->mutable_min() = ToProto(view.region->min);
    *request.mutable_region()->mutable_max() = ToProto(view.region->max);
  }
  request.mutable_species()->Assign(view.species.begin(), view.species.end());
}

}  // namespace

absl::StatusOr<MapView> MapViewFromProto(const v1::GetMapRequest& request) {
  return ReadView(request);
}

absl::StatusOr<MapView> MapViewFromProto(const v1::WatchMapRequest& request) {
  return ReadView(request);
}

void ToProto(const MapView& view, v1::GetMapRequest& request) { WriteView(view, request); }

void ToProto(const MapView& view, v1::WatchMapRequest& request) { WriteView(view, request); }

absl::StatusOr<RobotState> FromProto(const v1::RobotOnMap& proto, absl::string_view field) {
  RobotState robot;
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name,
                              ParseRobotName(Join(field, "robot"), proto.robot()));
  robot.id = name.robot;
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "radius_m"), proto.radius_m()));
  robot.radius_m = proto.radius_m();
  robot.has_pose = proto.has_pose();
  PLUMESCOUT_ASSIGN_OR_RETURN(robot.pose, FromProto(proto.pose(), Join(field, "pose")));
  robot.applied_sequence = proto.applied_sequence();
  robot.rejected_observations = proto.rejected_observation_count();
  robot.silent = proto.silent();
  robot.frame_suspect = proto.frame_suspect();
  return robot;
}

v1::RobotOnMap ToProto(const RobotState& robot, const MissionId& mission) {
  v1::RobotOnMap proto;
  proto.set_robot(RobotResource({mission, robot.id}));
  proto.set_radius_m(robot.radius_m);
  if (robot.has_pose) *proto.mutable_pose() = ToProto(robot.pose);
  proto.set_applied_sequence(robot.applied_sequence);
  proto.set_rejected_observation_count(robot.rejected_observations);
  proto.set_silent(robot.silent);
  proto.set_frame_suspect(robot.frame_suspect);
  return proto;
}

GasQuality FromProto(const v1::GasQuality& proto) {
  return {.mean_error_ppm = proto.mean_error_ppm(),
          .variance_error_ratio = proto.variance_error_ratio(),
          .aged_to_ns = proto.aged_to_ns(),
          .ageing_error_ratio = proto.ageing_error_ratio(),
          .refreshes = proto.refresh_count(),
          .epochs = proto.epoch_count(),
          .healed = proto.healed_count(),
          .failures = proto.failure_count(),
          .drift_mean_ppm = proto.drift_mean_ppm(),
          .drift_variance_ratio = proto.drift_variance_ratio(),
          .noise_scale = proto.noise_ratio(),
          .noise_log_stddev = proto.noise_log_stddev(),
          .prior_precision_scale = proto.prior_precision_ratio(),
          .prior_precision_log_stddev = proto.prior_precision_log_stddev(),
          .clean_air_scale = proto.clean_air_noise_ratio() > 0.0 ? proto.clean_air_noise_ratio()
                                                                 : proto.noise_ratio()};
}

GasAudits AuditsFromProto(const v1::GasQuality& proto) {
  return {.audits = proto.audit_count(),
          .mean_ppm = proto.audit_mean_ppm(),
          .variance_ratio = proto.audit_variance_ratio(),
          .alarms = proto.audit_alarm_count()};
}

v1::GasQuality ToProto(const GasQuality& quality, const GasAudits& audits) {
  v1::GasQuality proto;
  proto.set_mean_error_ppm(quality.mean_error_ppm);
  proto.set_variance_error_ratio(quality.variance_error_ratio);
  proto.set_aged_to_ns(quality.aged_to_ns);
  proto.set_ageing_error_ratio(quality.ageing_error_ratio);
  proto.set_refresh_count(quality.refreshes);
  proto.set_epoch_count(quality.epochs);
  proto.set_healed_count(quality.healed);
  proto.set_failure_count(quality.failures);
  proto.set_audit_count(audits.audits);
  proto.set_audit_mean_ppm(audits.mean_ppm);
  proto.set_audit_variance_ratio(audits.variance_ratio);
  proto.set_audit_alarm_count(audits.alarms);
  proto.set_drift_mean_ppm(quality.drift_mean_ppm);
  proto.set_drift_variance_ratio(quality.drift_variance_ratio);
  proto.set_noise_ratio(quality.noise_scale);
  proto.set_noise_log_stddev(quality.noise_log_stddev);
  proto.set_prior_precision_ratio(quality.prior_precision_scale);
  proto.set_prior_precision_log_stddev(quality.prior_precision_log_stddev);
  proto.set_clean_air_noise_ratio(quality.clean_air_scale);
  return proto;
}

v1::MapStatus ToProto(const MapStatus& status, const GridGeometry& geometry,
                      const MissionId& mission) {
  v1::MapStatus proto;
  *proto.mutable_geometry() = ToProto(geometry);
  proto.set_gas_threshold_ppm(status.gas_threshold_ppm);
  for (const Frontier& frontier : status.frontiers) *proto.add_frontiers() = ToProto(frontier);
  for (const RobotState& robot : status.robots) *proto.add_robots() = ToProto(robot, mission);
  *proto.mutable_gas_counters() = ToProto(status.gas_counters);
  *proto.mutable_gas_quality() = ToProto(status.gas_quality, status.gas_audits);
  for (const SensorOffset& offset : status.sensor_offsets) {
    *proto.add_sensor_offsets() = ToProto(offset, mission);
  }
  for (const GasStatus& gas : status.gases) {
    v1::GasStatus& added = *proto.add_gases();
    added.set_species(gas.species);
    *added.mutable_gas_counters() = ToProto(gas.counters);
    *added.mutable_gas_quality() = ToProto(gas.quality, gas.audits);
  }
  *proto.mutable_keep_out() = ToProto(status.keep_out);
  proto.set_phase(ToProto(status.phase));
  proto.set_reachable_area_m2(status.completeness.reachable_area_m2);
  proto.set_observed_area_m2(status.completeness.observed_area_m2);
  if (status.objective) {
    *proto.mutable_objective() = ToProto(*status.objective);
    proto.mutable_objective()->set_explanation(status.objective_explanation);
  }
  return proto;
}

absl::StatusOr<MapStatus> FromProto(const v1::MapStatus& proto, absl::string_view field) {
  MapStatus map;
  PLUMESCOUT_RETURN_IF_ERROR(ReadLists(proto, field, map));
  PLUMESCOUT_ASSIGN_OR_RETURN(map.phase, FromProto(proto.phase(), Join(field, "phase")));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckFinite(Join(field, "gas_threshold_ppm"), proto.gas_threshold_ppm()));
  map.gas_threshold_ppm = proto.gas_threshold_ppm();
  PLUMESCOUT_RETURN_IF_ERROR(ReadCompleteness(proto, field, map.completeness));
  map.gas_counters = FromProto(proto.gas_counters());
  map.gas_quality = FromProto(proto.gas_quality());
  map.gas_audits = AuditsFromProto(proto.gas_quality());
  for (int i = 0; i < proto.sensor_offsets_size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        SensorOffset offset, FromProto(proto.sensor_offsets(i), Join(field, "sensor_offsets", i)));
    map.sensor_offsets.push_back(std::move(offset));
  }
  for (const v1::GasStatus& gas : proto.gases()) {
    map.gases.push_back({gas.species(), FromProto(gas.gas_counters()), FromProto(gas.gas_quality()),
                         AuditsFromProto(gas.gas_quality())});
  }
  if (proto.has_objective()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(map.objective,
                                FromProto(proto.objective(), Join(field, "objective")));
    map.objective_explanation = proto.objective().explanation();
  }
  return map;
}

void ClearMap(const GridGeometry& geometry, MapSnapshot& map) {
  map.occupancy = Grid<CellState>(geometry, CellState::kUnknown);
  map.gas_mean_ppm = Grid<float>(geometry, std::numeric_limits<float>::quiet_NaN());
  map.gas_variance_ppm2 = map.gas_mean_ppm;
  map.further_gases.clear();
}

absl::Status DecodeTile(const v1::MapTile& tile, absl::string_view field, MapSnapshot& map) {
  if (!tile.species().empty()) return DecodeFurther(tile, field, map);
  switch (tile.layer()) {
    case v1::MAP_LAYER_OCCUPANCY:
      return DecodeStates(tile, field, map.occupancy);
    case v1::MAP_LAYER_GAS_MEAN:
      return DecodeValues(tile, field, map.gas_mean_ppm);
    case v1::MAP_LAYER_GAS_VARIANCE:
      return DecodeValues(tile, field, map.gas_variance_ppm2);
    default:
      return FieldError(Join(field, "layer"), tile.layer(), "is not a layer");
  }
}

absl::StatusOr<MapSnapshot> FromProto(const v1::GetMapResponse& proto) {
  MapSnapshot map;
  PLUMESCOUT_ASSIGN_OR_RETURN(static_cast<MapStatus&>(map), FromProto(proto.status(), "status"));
  map.revision = proto.revision();
  PLUMESCOUT_ASSIGN_OR_RETURN(const GridGeometry geometry,
                              proto.has_tile_geometry()
                                  ? FromProto(proto.tile_geometry(), "tile_geometry")
                                  : FromProto(proto.status().geometry(), "status.geometry"));
  ClearMap(geometry, map);
  PLUMESCOUT_RETURN_IF_ERROR(AddTiles(proto, map));
  return map;
}

absl::Status AddTiles(const v1::GetMapResponse& part, MapSnapshot& map) {
  for (int i = 0; i < part.tiles_size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(DecodeTile(part.tiles(i), Join("", "tiles", i), map));
  }
  return absl::OkStatus();
}

}  // namespace plumescout
