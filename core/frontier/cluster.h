// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/grid/padded.h"
#include "core/types/frontier.h"
#include "core/types/grid_geometry.h"

namespace plumescout {

// How the inner wavefront of WFD and WGFD gathers one cluster.
struct ClusterRule {
  FrontierKind kind = FrontierKind::kOccupancy;
  std::uint8_t waiting = 0;  // value of frontier cells that belong to no cluster yet
  std::uint8_t taken = 0;    // what replaces it
  int min_cells = 1;         // smaller clusters are marked too_small
};

// The maximal 8-connected set of waiting cells around `seed`, an index whose value is
// rule.waiting, with its centroid: [XIT] Alg. 2 lines 12-23. The goal cell is left open.
// Cost: O(cells of the cluster).
Frontier TakeCluster(const GridGeometry& geometry, const ClusterRule& rule, int seed,
                     Padded<std::uint8_t>& cells);

}  // namespace plumescout
