// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/grid/neighbours.h"
#include "core/grid/travel_search.h"
#include "core/types/grid.h"

namespace plumescout {

inline constexpr double kUnreached_m = std::numeric_limits<double>::infinity();

// Length of the shortest way, straight and diagonal steps between cell centres, from the nearest
// source to each cell over non-zero cells of `passable`; kUnreached_m where there is none. Sources
// that are outside or not passable are passed over. Deterministic. Cost: O(cells).
Grid<double> TravelDistances_m(const Grid<std::uint8_t>& passable,
                               const std::vector<SearchSource>& sources,
                               Connectivity connectivity = Connectivity::kEightNoCornerCut);
Grid<double> TravelDistances_m(const Grid<std::uint8_t>& passable, const std::vector<Cell>& starts,
                               Connectivity connectivity = Connectivity::kEightNoCornerCut);

// The cells of a shortest way from a source to `goal`, both included, read back from the field
// that TravelDistances_m gave with the same connectivity. Empty if the goal is outside or
// unreached. Cost: O(cells of the way).
std::vector<Cell> ShortestPath(const Grid<double>& travel_m, Cell goal,
                               Connectivity connectivity = Connectivity::kEightNoCornerCut);

// The cells of a shortest way from `start` to the nearest non-zero cell of `targets` over non-zero
// cells of `passable`, corners not cut; {start} if it is a target itself. `start` counts as
// passable. Of equally near targets the one with the least index is taken. Empty if there is none.
// REQUIRES: both rasters share one geometry. Cost: O(cells nearer than the target) steps.
std::vector<Cell> PathToNearest(const Grid<std::uint8_t>& passable,
                                const Grid<std::uint8_t>& targets, Cell start);

// Sum of the steps along `path`, a chain of 8-neighbours.
double PathLength_m(const std::vector<Cell>& path, double resolution_m);

}  // namespace plumescout
