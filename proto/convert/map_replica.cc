// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/map_replica.h"

#include <cstdint>
#include <utility>

#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"
#include "proto/convert/map.h"

namespace plumescout {

absl::Status MapReplica::Apply(const v1::WatchMapResponse& frame) {
  whole_ = false;
  if (frame.kind() == v1::WatchMapResponse::KIND_RESET) {
    held_ = false;
    return absl::OkStatus();
  }
  if (frame.kind() == v1::WatchMapResponse::KIND_FULL) {
    PLUMESCOUT_RETURN_IF_ERROR(Restart(frame));
  } else if (!held_) {
    return FieldError("kind", "must be FULL where no map is held");
  } else if (frame.base_revision() != map_.revision) {
    return FieldError("base_revision", static_cast<double>(frame.base_revision()),
                      "is not the revision held");
  }
  if (frame.has_status()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(static_cast<MapStatus&>(map_), FromProto(frame.status(), "status"));
  }
  map_.revision = frame.revision();
  for (int i = 0; i < frame.tiles_size(); ++i) {
    const v1::MapTile& tile = frame.tiles(i);
    PLUMESCOUT_RETURN_IF_ERROR(DecodeTile(tile, Join("", "tiles", i), map_));
    if (changes_.everything) continue;
    changes_.rects.insert(
        CellRect::Sized(FromProto(tile.min_cell()), tile.column_count(), tile.row_count()));
  }
  whole_ = !frame.more_follow();
  return absl::OkStatus();
}

MapChanges MapReplica::TakeChanges() { return std::exchange(changes_, {}); }

absl::Status MapReplica::Restart(const v1::WatchMapResponse& frame) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const GridGeometry geometry,
                              FromProto(frame.tile_geometry(), "tile_geometry"));
  ClearMap(geometry, map_);
  changes_ = {.everything = true, .rects = {}};
  held_ = true;
  return absl::OkStatus();
}

}  // namespace plumescout
