// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/grid/travel_search.h"
#include "core/types/cell_rect.h"
#include "core/types/cell_state.h"
#include "core/types/frontier.h"
#include "core/types/grid.h"
#include "core/types/stop.h"

namespace plumescout {

// The ways from some starts over traversable cells, corners not cut.
using TravelFromStarts = TravelSearch<double>;

// The start cells that are free, and for those that are not (a robot on a cell not seen yet, or
// hit by noise) the nearest free cell over unknown ones, if any.
std::vector<Cell> FreeStarts(const Grid<CellState>& states, const std::vector<Cell>& starts);

// Free cells and their neighbours lie in this rectangle, and with them all cells of frontiers.
CellRect CellsAroundFree(const Grid<CellState>& states);

// Fills in goal_cell, travel_m and reachable of each frontier.
//
// Where to go for a cluster: a centroid lies on an untraversable cell in about 10 % of cases, and
// that of a ring lies where the robot stands. So the cluster is represented by its *anchor*, the
// cell of the cluster nearest to the centroid (ties: least index). The goal cell is the traversable
// cell that some start can reach (over traversable cells, corners not cut, out of the inflated zone
// first by EscapePath) from which the way to the anchor is shortest, by 8-connected steps over free
// and frontier cells; it is the anchor itself if that is such a cell. A robot does not drive the
// last bit, so it may squeeze past corners.
//
// travel_m is the length of the way from the nearest start, the escape included. A frontier is not
// reachable if no start has a traversable cell, or no way leads on to the anchor.
//
// REQUIRES: both rasters share one geometry. Cost: O(cells), however many frontiers there are.
void FindGoalCells(const Grid<CellState>& states, const Grid<std::uint8_t>& traversable,
                   const std::vector<Cell>& starts, std::vector<Frontier>& frontiers);
// The same by ways that are known; of no use once `stop`, which is asked all along, says so.
// REQUIRES: `from_starts` has run, over the same geometry and CellsAroundFree.
void FindGoalCells(const Grid<CellState>& states, const TravelFromStarts& from_starts,
                   std::vector<Frontier>& frontiers, const StopFn& stop = {});

}  // namespace plumescout
