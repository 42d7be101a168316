// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "core/tour/tour_graph.h"

namespace plumescout {

// Sets of nodes that hang together by the edges taken, if there are several: the constraints [LHR]
// (P1b) on them are violated. `x` says how far each edge is taken, from 0 to 1, with a sum of 2 at
// each node. Nothing if all nodes hang together: if edges are taken whole, in one tour. Nodes of a
// set, and sets by their first node, are ascending. Cost: O(nodes + edges).
std::vector<std::vector<int>> FindSubtours(const TourGraph& graph, std::span<const double> x);

}  // namespace plumescout
