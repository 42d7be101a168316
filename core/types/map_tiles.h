// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace plumescout {

// A mission's map consists of whole tiles of this many cells a side, counted from (0,0) of frame
// map: growth then moves its origin by whole tiles, and cells keep their place.
inline constexpr std::int64_t kMapTileCells = 64;

// Whole tiles along one axis.
struct TileSpan {
  std::int64_t begin = 0;
  std::int64_t end = 0;

  std::int64_t cells() const { return (end - begin) * kMapTileCells; }
  bool empty() const { return begin == end; }
};

inline std::int64_t TileOfCell(std::int64_t cell) {
  return cell >= 0 ? cell / kMapTileCells : -((kMapTileCells - 1 - cell) / kMapTileCells);
}

// The tiles of cells first - 1 .. last + 1, and those of `span`: each cell that is known has all
// its neighbours on the map.
inline TileSpan TilesAround(const TileSpan& span, std::int64_t first, std::int64_t last) {
  const TileSpan needed = {TileOfCell(first - 1), TileOfCell(last + 1) + 1};
  if (span.empty()) return needed;
  return {std::min(span.begin, needed.begin), std::max(span.end, needed.end)};
}

}  // namespace plumescout
