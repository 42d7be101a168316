// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/types/grid_geometry.h"
#include "core/types/pose2.h"

namespace plumescout::lab {

// In frame map.
struct Velocity {
  double u_mps = 0.0;  // eastward
  double v_mps = 0.0;  // northward
};

// Velocity on the faces of a raster's cells (marker-and-cell staggering, Harlow and Welch 1965):
// u on the (width + 1) x height vertical faces, v on the width x (height + 1) horizontal ones.
// Cell (x,y) has u(x,y) on its west face, u(x+1,y) on its east face, v(x,y) on its south face,
// v(x,y+1) on its north face.
class MacField {
 public:
  MacField() = default;
  explicit MacField(const GridGeometry& geometry);

  const GridGeometry& geometry() const { return geometry_; }
  double& u(int x, int y) { return values_mps_[UFace(x, y)]; }
  double u(int x, int y) const { return values_mps_[UFace(x, y)]; }
  double& v(int x, int y) { return values_mps_[VFace(x, y)]; }
  double v(int x, int y) const { return values_mps_[VFace(x, y)]; }

  // All faces in one row, for those who walk along lists of faces: first u, then v.
  std::span<double> values() { return values_mps_; }
  std::span<const double> values() const { return values_mps_; }
  std::size_t UFace(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(geometry_.width + 1) +
           static_cast<std::size_t>(x);
  }
  std::size_t VFace(int x, int y) const {
    return first_v_ + static_cast<std::size_t>(y) * static_cast<std::size_t>(geometry_.width) +
           static_cast<std::size_t>(x);
  }

  // Net flow out of a cell per metre of height and cell edge, m/s.
  double NetOutflow_mps(Cell cell) const {
    return u(cell.x + 1, cell.y) - u(cell.x, cell.y) + v(cell.x, cell.y + 1) - v(cell.x, cell.y);
  }
  Velocity AtCenter(Cell cell) const;
  // Linear across each cell between its own faces and constant along them: divergence-free inside
  // every cell that is so as a whole, and without flow through its walls. Zero off the raster.
  Velocity At(Point2 point) const;

  // this += factor * other. REQUIRES: the same geometry.
  void AddScaled(const MacField& other, double factor);
  // max |u| and max |v|, each over its own faces.
  Velocity MaxMagnitudes() const;
  // max |u| + max |v| over the faces of one cell, of the cell where that is largest: the rate at
  // which a time step uses up cells.
  double FastestCell_mps() const;

 private:
  GridGeometry geometry_;
  std::size_t first_v_ = 0;
  std::vector<double> values_mps_;
};

}  // namespace plumescout::lab
