// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/flow_faces.h"

namespace plumescout::lab {
namespace {

constexpr std::uint8_t kFreeWest = 1;
constexpr std::uint8_t kFreeSouth = 2;

std::uint8_t BitOf(Axis axis) { return axis == Axis::kX ? kFreeWest : kFreeSouth; }

}  // namespace

OpeningFaces FacesOf(const BoundaryFace& opening) {
  const bool along_x = opening.side == Side::kWest || opening.side == Side::kEast;
  const bool at_origin = opening.side == Side::kWest || opening.side == Side::kSouth;
  const Axis axis = along_x ? Axis::kX : Axis::kY;
  const Face low{opening.cell, axis};
  const Face high{Plus(opening.cell, Unit(axis)), axis};
  return at_origin ? OpeningFaces{low, high, 1.0} : OpeningFaces{high, low, -1.0};
}

FreeFaces::FreeFaces(const FlowDomain& domain) : free_(domain.fluid.geometry()) {
  for (std::size_t i = 0; i < domain.fluid.size(); ++i) {
    if (domain.fluid[i] == 0) continue;
    const Cell cell = domain.fluid.geometry().CellAtIndex(i);
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      if (domain.fluid.At(Minus(cell, Unit(axis)), 0) != 0) free_[i] |= BitOf(axis);
    }
  }
  for (const FanFace& fan : domain.fans) {
    free_[fan.cell] &= static_cast<std::uint8_t>(~BitOf(FaceOf(fan).axis));
  }
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const Cell cell = free_.geometry().CellAtIndex(i);
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      if (IsFree({cell, axis})) all_.push_back({cell, axis});
    }
  }
}

bool FreeFaces::IsFree(const Face& face) const {
  return (free_.At(face.ahead, 0) & BitOf(face.axis)) != 0;
}

}  // namespace plumescout::lab
