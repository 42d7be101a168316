// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/grid.h"
#include "core/types/pose2.h"

namespace plumescout {

// How to drive from one place to another; empty if there is no way.
struct Way {
  std::vector<Point2> vertices;  // both ends included
  double length_m = 0.0;
};

// Whether the straight segment touches no cell that is closed. Cost: O(cells crossed).
bool IsClear(const Grid<std::uint8_t>& passable, Point2 from, Point2 to);

// From one place to each of several: straight where that is clear, else along the shortest way on
// the 8-connected grid, with corners pulled tight. [LHR] has no obstacles and drives straight; ways
// round them are ours. Both ends lie in passable cells, and ways end where they are asked to.
// Cost: O(cells) if any is not in straight sight.
std::vector<Way> WaysFrom(const Grid<std::uint8_t>& passable, Point2 from,
                          const std::vector<Point2>& places);

}  // namespace plumescout
