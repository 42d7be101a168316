// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/map_frames.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace plumescout::server {
namespace {

// Bytes, not values: a NaN that stays is no change.
template <typename T>
bool RowsDiffer(const Grid<T>& a, const Grid<T>& b, const CellRect& rect) {
  const std::size_t bytes = static_cast<std::size_t>(rect.width) * sizeof(T);
  for (int row = 0; row < rect.height; ++row) {
    const Cell first{rect.min.x, rect.min.y + row};
    if (std::memcmp(&a[first], &b[first], bytes) != 0) return true;
  }
  return false;
}

bool Differ(const MapSnapshot& a, const MapSnapshot& b, const MapView& view, const CellRect& rect) {
  return (view.occupancy && RowsDiffer(a.occupancy, b.occupancy, rect)) ||
         (view.gas_mean && RowsDiffer(a.gas_mean_ppm, b.gas_mean_ppm, rect)) ||
         (view.gas_variance && RowsDiffer(a.gas_variance_ppm2, b.gas_variance_ppm2, rect));
}

std::vector<v1::MapTile> ChangedTiles(const MapSnapshot& before, const MapSnapshot& now,
                                      const MapView& view) {
  std::vector<v1::MapTile> changed;
  const GridGeometry& geometry = now.occupancy.geometry();
  for (int y = 0; y < geometry.height; y += kDeltaTileCells) {
    for (int x = 0; x < geometry.width; x += kDeltaTileCells) {
      const CellRect rect{{x, y},
                          std::min(kDeltaTileCells, geometry.width - x),
                          std::min(kDeltaTileCells, geometry.height - y)};
      if (!Differ(before, now, view, rect)) continue;
      for (v1::MapTile& tile : EncodeTiles(now, view, rect)) changed.push_back(std::move(tile));
    }
  }
  return changed;
}

v1::WatchMapResponse Frame(v1::WatchMapResponse::Kind kind, const MapSnapshot& now) {
  v1::WatchMapResponse frame;
  frame.set_kind(kind);
  frame.set_revision(now.revision);
  return frame;
}

v1::WatchMapResponse FullFrame(const MapSnapshot& now, const MissionId& mission,
                               const MapView& view) {
  v1::GetMapResponse map = ToProto(now, mission, view);
  v1::WatchMapResponse frame = Frame(v1::WatchMapResponse::KIND_FULL, now);
  frame.mutable_status()->Swap(map.mutable_status());
  frame.mutable_tiles()->Swap(map.mutable_tiles());
  return frame;
}

}  // namespace

std::vector<v1::WatchMapResponse> FramesBetween(const MapSnapshot* before, const MapSnapshot& now,
                                                const MissionId& mission, const MapView& view) {
  if (before == nullptr) return {FullFrame(now, mission, view)};
  if (before->occupancy.geometry() != now.occupancy.geometry()) {
    v1::WatchMapResponse reset = Frame(v1::WatchMapResponse::KIND_RESET, now);
    reset.set_base_revision(before->revision);
    return {std::move(reset), FullFrame(now, mission, view)};
  }
  if (before->revision == now.revision) return {};
  v1::WatchMapResponse frame = Frame(v1::WatchMapResponse::KIND_DELTA, now);
  for (v1::MapTile& tile : ChangedTiles(*before, now, view)) *frame.add_tiles() = std::move(tile);
  if (frame.tiles().empty()) frame.set_kind(v1::WatchMapResponse::KIND_PROGRESS);
  frame.set_base_revision(before->revision);
  *frame.mutable_status() = StatusToProto(now, mission);
  return {std::move(frame)};
}

}  // namespace plumescout::server
