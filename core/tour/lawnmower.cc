// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/tour/lawnmower.h"

#include <limits>

#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// One axis of the lattice, from the side where the sweep begins.
struct Side {
  int points = 1;
  int stride = 1;
  bool mirrored = false;  // begins at the greater coordinate

  int Stops() const { return (points - 1) / stride + 1; }
  int At(int stop) const {
    const int offset = stop * stride;
    return mirrored ? points - 1 - offset : offset;
  }
};

absl::Status CheckSweep(const Sweep& sweep) {
  constexpr int kMax = std::numeric_limits<int>::max();
  return Checker()
      .InRange("width", sweep.width, 1, kMax)
      .InRange("height", sweep.height, 1, kMax)
      .InRange("point_stride", sweep.point_stride, 1, kMax)
      .InRange("leg_stride", sweep.leg_stride, 1, kMax)
      .status();
}

}  // namespace

absl::StatusOr<std::vector<Cell>> LawnmowerOrder(const Sweep& sweep) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckSweep(sweep));
  const bool along_x = sweep.legs == SweepAxis::kX;
  const bool east =
      sweep.begin == SweepCorner::kSouthEast || sweep.begin == SweepCorner::kNorthEast;
  const bool north =
      sweep.begin == SweepCorner::kNorthWest || sweep.begin == SweepCorner::kNorthEast;
  const Side x{sweep.width, along_x ? sweep.point_stride : sweep.leg_stride, east};
  const Side y{sweep.height, along_x ? sweep.leg_stride : sweep.point_stride, north};
  const Side& along = along_x ? x : y;
  const Side& across = along_x ? y : x;
  std::vector<Cell> order;
  for (int leg = 0; leg < across.Stops(); ++leg) {
    for (int i = 0; i < along.Stops(); ++i) {
      const int at = along.At(leg % 2 == 0 ? i : along.Stops() - 1 - i);
      order.push_back(along_x ? Cell{at, across.At(leg)} : Cell{across.At(leg), at});
    }
  }
  return order;
}

}  // namespace plumescout
