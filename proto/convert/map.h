// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/map_snapshot.h"
#include "core/types/map_view.h"
#include "plumescout/v1/map_service.pb.h"
#include "proto/convert/raster.h"

namespace plumescout {

// No layers: all. Unset and unknown layers are refused, as are regions that end before they begin.
// Whether the mission has such gases is for CheckSpecies to say.
absl::StatusOr<MapView> MapViewFromProto(const v1::GetMapRequest& request);
absl::StatusOr<MapView> MapViewFromProto(const v1::WatchMapRequest& request);
void ToProto(const MapView& view, v1::GetMapRequest& request);
void ToProto(const MapView& view, v1::WatchMapRequest& request);

v1::RobotOnMap ToProto(const RobotState& robot, const MissionId& mission);
// kInvalidArgument naming fields below `field`.
absl::StatusOr<RobotState> FromProto(const v1::RobotOnMap& proto, absl::string_view field);
v1::GasQuality ToProto(const GasQuality& quality, const GasAudits& audits);
GasQuality FromProto(const v1::GasQuality& proto);
GasAudits AuditsFromProto(const v1::GasQuality& proto);
// Everything but revision and rasters.
v1::MapStatus ToProto(const MapStatus& status, const GridGeometry& geometry,
                      const MissionId& mission);
// All but the revision, which is not part of the message.
absl::StatusOr<MapStatus> FromProto(const v1::MapStatus& proto, absl::string_view field);

// A map of which nothing is known: every square unknown, every gas NaN.
void ClearMap(const GridGeometry& geometry, MapSnapshot& map);
// Writes a tile into the map's raster of its layer.
absl::Status DecodeTile(const v1::MapTile& tile, absl::string_view field, MapSnapshot& map);
// The first part of a map, or all of it: rasters are of the tiles' geometry; what no tile covers is
// unknown, NaN.
absl::StatusOr<MapSnapshot> FromProto(const v1::GetMapResponse& proto);
// Adds the tiles of a later part.
absl::Status AddTiles(const v1::GetMapResponse& part, MapSnapshot& map);

}  // namespace plumescout
