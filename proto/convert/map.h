// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/map_snapshot.h"
#include "plumescout/v1/map_service.pb.h"
#include "proto/convert/raster.h"

namespace plumescout {

// What a reader of maps asked for.
struct MapView {
  bool occupancy = true;
  bool gas_mean = true;
  bool gas_variance = true;
  bool full_precision = false;  // gas layers as float32

  friend bool operator==(const MapView&, const MapView&) = default;
};

// No layers: all. Unset and unknown layers are refused.
absl::StatusOr<MapView> MapViewFromProto(const google::protobuf::RepeatedField<int>& layers,
                                         bool full_precision, absl::string_view field);

// The tiles of one rectangle, a layer each.
std::vector<v1::MapTile> EncodeTiles(const MapSnapshot& map, const MapView& view,
                                     const CellRect& rect);
v1::GasQuality ToProto(const GasQuality& quality, const GasAudits& audits);
// Everything but revision and rasters.
v1::MapStatus StatusToProto(const MapSnapshot& map, const MissionId& mission);
v1::GetMapResponse ToProto(const MapSnapshot& map, const MissionId& mission, const MapView& view);

// Writes a tile into the map's raster of its layer.
absl::Status DecodeTile(const v1::MapTile& tile, absl::string_view field, MapSnapshot& map);
// A map with the status' geometry and no tiles yet: all unknown, NaN.
absl::StatusOr<MapSnapshot> FromProto(const v1::MapStatus& proto, absl::string_view field);
absl::StatusOr<MapSnapshot> FromProto(const v1::GetMapResponse& proto);

}  // namespace plumescout
