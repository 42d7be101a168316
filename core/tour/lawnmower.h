// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "core/types/cell.h"

namespace plumescout {

enum class SweepAxis { kX, kY };
enum class SweepCorner { kSouthWest, kSouthEast, kNorthWest, kNorthEast };

// Boustrophedon over a lattice of points: up one leg, down the next.
struct Sweep {
  int width = 0;  // points from west to east, >= 1
  int height = 0;
  SweepAxis legs = SweepAxis::kX;               // what legs are parallel to
  SweepCorner begin = SweepCorner::kSouthWest;  // strides are counted from here
  int point_stride = 1;                         // from stop to stop on a leg, >= 1
  int leg_stride = 1;                           // from leg to leg, >= 1
};

// The stops in order, each once. What is left of a stride at the far sides has no stop.
// Errors: kInvalidArgument naming what is out of range.
absl::StatusOr<std::vector<Cell>> LawnmowerOrder(const Sweep& sweep);

}  // namespace plumescout
