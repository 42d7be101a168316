// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/grid/neighbours.h"
#include "core/types/grid.h"
#include "core/types/stop.h"

namespace plumescout {

// 1 on the cells that a wavefront from `starts` reaches over non-zero cells of `passable`, else 0.
// Starts that are outside or not passable are passed over. Of no use once `stop`, which is asked
// all along, says so. Cost: O(cells).
Grid<std::uint8_t> ReachableCells(const Grid<std::uint8_t>& passable,
                                  const std::vector<Cell>& starts,
                                  Connectivity connectivity = Connectivity::kEightNoCornerCut,
                                  const StopFn& stop = {});

struct Components {
  static constexpr int kNone = -1;

  Grid<int> label;         // kNone off the mask, else 0, 1, ... by least cell index
  std::vector<int> sizes;  // cells, by label
};

// Connected components of the non-zero cells of `passable`. Cost: O(cells).
Components ConnectedComponents(const Grid<std::uint8_t>& passable,
                               Connectivity connectivity = Connectivity::kEightNoCornerCut);

}  // namespace plumescout
