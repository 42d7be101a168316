// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/map_tiles.h"
#include "core/types/pose2.h"

namespace plumescout {

// Where the gas field of a mission is computed: on the tiles of the map that are no farther than
// `reach_m` from a tile where a robot has been. Elsewhere the field is so nearly its prior that a
// long view over open ground need not be paid for. The region only grows.
//
//   region.Visit(pose.position());
//   RETURN_IF_ERROR(gas.Refresh(region.Within(occupancy.States()), now_ns));
//
// What is left out ends the field as an unknown cell does: it is exact on what is left, and off
// the field of the whole map by what is behind the edge, which fades with the distance from it
// (docs/notation.md). Thread-compatible.
class FieldRegion {
 public:
  // Of maps with this resolution, which consist of whole tiles. `reach_m` 0: everywhere.
  FieldRegion(double reach_m, double resolution_m);

  // A robot is here. Cost: O(log tiles visited); of the tiles within reach if this is new.
  void Visit(Point2 place);
  // Robots might be anywhere on it.
  void VisitAll(const GridGeometry& geometry);
  bool IsNew(Point2 place) const { return !everywhere_ && !visited_.contains(TileAt(place)); }
  std::size_t visited_tiles() const { return visited_.size(); }

  // The map is this now. Cost: O(tiles visited) if it is another than before.
  void Follow(const GridGeometry& geometry);
  // `states` as far as they are in the region: themselves if all are, or a part, to be used until
  // the next call, whose cells outside the region are unknown. Cost: O(cells of that part).
  const Grid<CellState>& Within(const Grid<CellState>& states);
  // Whether a cell of the map last followed is in the region.
  bool Contains(Cell cell) const {
    return everywhere_ || inside_[TileIndex(cell.x / kTileCells, cell.y / kTileCells)] != 0;
  }

  // What one place brings in at most, and how wide that is.
  std::int64_t TilesAround() const;
  std::int64_t WidestAround_cells() const { return (2 * reach_tiles_ + 3) * kTileCells; }

  // Which tiles were visited; the map is to be followed anew after reading.
  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);

 private:
  static constexpr int kTileCells = static_cast<int>(kMapTileCells);

  // Counted from (0, 0) of the frame.
  struct Tile {
    std::int64_t x = 0;
    std::int64_t y = 0;

    friend auto operator<=>(const Tile&, const Tile&) = default;
    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };

  Tile TileAt(Point2 place) const;
  bool IsNear(std::int64_t dx, std::int64_t dy) const;
  std::size_t TileIndex(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  void Mark(const Tile& visited);
  const Grid<CellState>& Cut(const Grid<CellState>& states);

  double reach_m_;
  double resolution_m_;
  bool everywhere_;
  std::int64_t reach_tiles_;  // beyond the next tile
  std::set<Tile> visited_;

  // Of the map last followed.
  GridGeometry geometry_;
  Tile corner_;
  int width_ = 0;  // in tiles
  int height_ = 0;
  std::vector<std::uint8_t> inside_;  // by tile
  std::size_t inside_count_ = 0;
  Grid<CellState> part_;
};

}  // namespace plumescout
