// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/slice.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/types/grid_geometry.h"
#include "proto/convert/map.h"
#include "server/maps/layer_tiles.h"

namespace plumescout::server {

struct EncodedTile {
  LayerForm form;
  CellRect rect;
  StoredTile tile;
};

// A map at one revision as readers with one view have it: what messages are put together from.
// Its bytes are shared with other revisions and other views. Immutable.
struct EncodedMap {
  MapView view;
  std::int64_t revision = 0;
  std::int64_t geometry_since = 0;  // the revision since which the raster is where it is
  GridGeometry squares;             // the raster of the tiles
  grpc::Slice status;               // a v1::MapStatus
  std::vector<EncodedTile> tiles;   // that meet the view's region, layer by layer
};

// Messages of WatchMap that bring a reader to one revision. Immutable.
struct MapFrames {
  std::int64_t revision = 0;
  std::vector<grpc::ByteBuffer> messages;
};

inline constexpr std::int64_t kHoldsNothing = -1;

// For a reader who holds the revision `held`, with the same view: FULL, or RESET and FULL if the
// raster has moved or grown since, or DELTA with the tiles that differ, or PROGRESS if only the
// status does; and DELTAs with what has no room in the first. No message has more than `max_bytes`,
// but for one status or one tile that has.
MapFrames FramesSince(std::int64_t held, const EncodedMap& map, std::int64_t max_bytes);

// A part of the map for GetMap: tiles first_tile .. end_tile - 1, and the status before the first.
struct MapPart {
  v1::GetMapResponse head;  // without tiles and status
  std::size_t first_tile = 0;
  std::size_t end_tile = 0;
};
// What has room in `max_bytes`, but one tile at least.
MapPart CutPart(const EncodedMap& map, std::size_t first_tile, std::int64_t max_bytes);
grpc::ByteBuffer Build(const EncodedMap& map, const MapPart& part);

}  // namespace plumescout::server
