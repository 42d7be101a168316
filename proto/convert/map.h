// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/map_snapshot.h"
#include "core/types/rectangle.h"
#include "plumescout/v1/map_service.pb.h"
#include "proto/convert/raster.h"

namespace plumescout {

// What a reader of maps asked for.
struct MapView {
  bool occupancy = true;
  bool gas_mean = true;
  bool gas_variance = true;
  bool full_precision = false;                     // gas layers as float32
  int level_of_detail = 0;                         // squares of 2^n by 2^n cells make one
  std::optional<Rectangle> region = std::nullopt;  // none: all of the map
  std::vector<std::string> species = {};           // of gas layers; none: the first

  friend bool operator==(const MapView&, const MapView&) = default;
};

inline constexpr int kMaxLevelOfDetail = 6;

// No layers: all. Unset and unknown layers are refused, as are regions that end before they begin.
// Whether the mission has such gases is for CheckSpecies to say.
absl::StatusOr<MapView> MapViewFromProto(const v1::GetMapRequest& request);
absl::StatusOr<MapView> MapViewFromProto(const v1::WatchMapRequest& request);

v1::RobotOnMap ToProto(const RobotState& robot, const MissionId& mission);
// kInvalidArgument naming fields below `field`.
absl::StatusOr<RobotState> FromProto(const v1::RobotOnMap& proto, absl::string_view field);
v1::GasQuality ToProto(const GasQuality& quality, const GasAudits& audits);
// Everything but revision and rasters.
v1::MapStatus ToProto(const MapStatus& status, const GridGeometry& geometry,
                      const MissionId& mission);

// Writes a tile into the map's raster of its layer.
absl::Status DecodeTile(const v1::MapTile& tile, absl::string_view field, MapSnapshot& map);
// The first part of a map, or all of it: rasters are of the tiles' geometry; what no tile covers is
// unknown, NaN.
absl::StatusOr<MapSnapshot> FromProto(const v1::GetMapResponse& proto);
// Adds the tiles of a later part.
absl::Status AddTiles(const v1::GetMapResponse& part, MapSnapshot& map);

}  // namespace plumescout
