// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lab/sim/flow_domain.h"
#include "lab/sim/mac_field.h"

namespace plumescout::lab {

enum class Axis { kX, kY };

constexpr Axis Other(Axis axis) { return axis == Axis::kX ? Axis::kY : Axis::kX; }
constexpr Cell Unit(Axis axis) { return axis == Axis::kX ? Cell{1, 0} : Cell{0, 1}; }
constexpr Cell Plus(Cell cell, Cell step) { return {cell.x + step.x, cell.y + step.y}; }
constexpr Cell Minus(Cell cell, Cell step) { return {cell.x - step.x, cell.y - step.y}; }

// Face of a MacField: of the cells that it parts, the one farther along the axis, and the axis,
// which the face is at right angles to: kX is the west face of `ahead`, kY its south face.
struct Face {
  Cell ahead;
  Axis axis = Axis::kX;

  Cell behind() const { return Minus(ahead, Unit(axis)); }
};

inline std::size_t IndexOf(const Face& face, const MacField& field) {
  const auto [x, y] = face.ahead;
  return face.axis == Axis::kX ? field.UFace(x, y) : field.VFace(x, y);
}

inline Face FaceOf(const FanFace& fan) {
  return {fan.cell, fan.side == Side::kWest ? Axis::kX : Axis::kY};
}

// An opening on the raster's edge, the parallel face of its cell one step inside, and the sign of
// inward flow.
struct OpeningFaces {
  Face outer;
  Face inner;
  double inward = 1.0;
};

OpeningFaces FacesOf(const BoundaryFace& opening);

// Which faces pressure and friction act on: those between two fluid cells, unless a fan holds them.
class FreeFaces {
 public:
  explicit FreeFaces(const FlowDomain& domain);

  bool IsFree(const Face& face) const;
  const std::vector<Face>& all() const { return all_; }  // by cell, kX first

 private:
  Grid<std::uint8_t> free_;  // sum of kFreeWest and kFreeSouth
  std::vector<Face> all_;
};

}  // namespace plumescout::lab
