// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/types/cell_state.h"
#include "core/types/grid.h"

namespace plumescout {

// 1 where a robot may drive: free and farther than inflation_radius_m (centre to centre, exact
// Euclidean) from every occupied cell; else 0. [XIT] Table I inflates by 0.2 m.
// REQUIRES: inflation_radius_m >= 0. Cost: O(cells * radius in cells) in vectorised steps.
Grid<std::uint8_t> TraversableCells(const Grid<CellState>& states, double inflation_radius_m);

}  // namespace plumescout
