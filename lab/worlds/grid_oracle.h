// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/cost/edge_cost.h"
#include "core/types/grid.h"

namespace plumescout::lab {

// Least price from the centre of `start` to the centre of every cell, +infinity where there is no
// way, over straight steps between cell centres: plain Dijkstra with a heap, slow and simple.
// `connectivity` is the number of directions of the steps: 8, 16 or 32. The more, the nearer to
// the price of the best continuous path; 8 is about 3 to 4 % above it.
Grid<double> OracleCosts(const EdgeCost& cost, Cell start, int connectivity);

}  // namespace plumescout::lab
