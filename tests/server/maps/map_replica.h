// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "proto/convert/geometry.h"
#include "proto/convert/map.h"
#include "server/maps/encoded_map.h"
#include "server/maps/wire_message.h"

namespace plumescout::server {

// A watcher's copy of a map, as the comments of WatchMapResponse say.
class MapReplica {
 public:
  void Apply(const v1::WatchMapResponse& frame) {
    switch (frame.kind()) {
      case v1::WatchMapResponse::KIND_RESET:
        ASSERT_EQ(frame.base_revision(), revision_);
        forgotten_ = true;
        return;
      case v1::WatchMapResponse::KIND_FULL:
        ASSERT_TRUE(forgotten_ || revision_ == kHoldsNothing);
        forgotten_ = false;
        Clear(FromProto(frame.tile_geometry(), "tile_geometry").value());
        break;
      default:
        ASSERT_FALSE(forgotten_);
        ASSERT_EQ(frame.base_revision(), revision_);
    }
    revision_ = frame.revision();
    for (const v1::MapTile& tile : frame.tiles()) {
      ASSERT_TRUE(DecodeTile(tile, "tile", map_).ok());
    }
  }
  void Apply(const MapFrames& frames) {
    for (std::size_t i = 0; i < frames.messages.size(); ++i) {
      v1::WatchMapResponse frame;
      ASSERT_TRUE(Parse(frames.messages[i], frame).ok());
      EXPECT_EQ(frame.more_follow(), i + 1 < frames.messages.size());
      Apply(frame);
    }
    EXPECT_EQ(revision_, frames.revision);
  }

  std::int64_t revision() const { return revision_; }
  const MapSnapshot& map() const { return map_; }

 private:
  void Clear(const GridGeometry& geometry) {
    map_.occupancy = Grid<CellState>(geometry, CellState::kUnknown);
    map_.gas_mean_ppm = Grid<float>(geometry, std::numeric_limits<float>::quiet_NaN());
    map_.gas_variance_ppm2 = map_.gas_mean_ppm;
  }

  std::int64_t revision_ = kHoldsNothing;
  bool forgotten_ = false;
  MapSnapshot map_;
};

}  // namespace plumescout::server
