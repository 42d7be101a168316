// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/grid_geometry.h"
#include "core/types/pose2.h"
#include "lab/sim/gas_space.h"
#include "lab/sim/layout_raster.h"
#include "lab/sim/mac_field.h"

namespace plumescout::lab {

// What filaments meet in every step: the wind, what cells are to gas, and whether a way is clear.
// The same as MacField::At and a walk through GasSpaces, but several times as fast, since all that
// concerns a cell lies together.
class Air {
 public:
  // REQUIRES: both of one geometry.
  Air(const LayoutRaster& raster, const MacField& wind);

  // Zero beyond the raster, which is outside. REQUIRES: less than 2^31 cells away.
  Velocity WindAt(Point2 point) const;
  GasSpace SpaceAt(Point2 point) const { return SpotOf(point).cell_air.space; }
  // Whether no solid is in the straight way, whatever its length.
  bool Clear(Point2 from, Point2 to) const;

 private:
  struct CellAir {
    float west_mps = 0.0F;  // through the cell's faces
    float east_mps = 0.0F;
    float south_mps = 0.0F;
    float north_mps = 0.0F;
    GasSpace space = GasSpace::kOutside;
    std::uint8_t clearance_cells = 0;
  };
  struct Spot {
    Cell cell;
    double east;  // from the cell's south-western corner, in cells
    double north;
    const CellAir& cell_air;
  };

  static int WholeCells(double cells);
  const CellAir& In(Cell cell) const {
    return geometry_.Contains(cell) ? cells_[geometry_.Index(cell)] : beyond_;
  }
  Spot SpotOf(Point2 point) const;
  bool WalkIsClear(Point2 from, Point2 to) const;

  GridGeometry geometry_;
  double cells_per_m_;
  std::vector<CellAir> cells_;
  CellAir beyond_;
};

// As GridGeometry::CellAt, without its division, floor and clamp.
inline int Air::WholeCells(double cells) {
  constexpr double kEdge_cells = 1e-9;
  const int whole = static_cast<int>(cells + kEdge_cells);
  return whole - (cells + kEdge_cells < whole ? 1 : 0);
}

inline Air::Spot Air::SpotOf(Point2 point) const {
  const double east = (point.x_m - geometry_.origin_x_m) * cells_per_m_;
  const double north = (point.y_m - geometry_.origin_y_m) * cells_per_m_;
  const Cell cell{WholeCells(east), WholeCells(north)};
  return {cell, east - cell.x, north - cell.y, In(cell)};
}

inline Velocity Air::WindAt(Point2 point) const {
  const Spot spot = SpotOf(point);
  const CellAir& air = spot.cell_air;
  return {air.west_mps + spot.east * (air.east_mps - air.west_mps),
          air.south_mps + spot.north * (air.north_mps - air.south_mps)};
}

inline bool Air::Clear(Point2 from, Point2 to) const {
  const Spot first = SpotOf(from);
  const Spot last = SpotOf(to);
  const int east =
      last.cell.x > first.cell.x ? last.cell.x - first.cell.x : first.cell.x - last.cell.x;
  const int north =
      last.cell.y > first.cell.y ? last.cell.y - first.cell.y : first.cell.y - last.cell.y;
  if ((east > north ? east : north) < first.cell_air.clearance_cells) return true;
  if (east + north <= 1) return last.cell_air.space != GasSpace::kSolid;  // no cell in between
  return WalkIsClear(from, to);
}

}  // namespace plumescout::lab
