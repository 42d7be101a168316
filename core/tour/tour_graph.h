// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "absl/status/status.h"
#include "core/types/cell.h"

namespace plumescout {

// Undirected way between two nodes.
struct TourEdge {
  int a = 0;
  int b = 0;
  double cost_m = 0.0;
};

// Nodes are 0 ... nodes - 1. Where there is no way there is no edge.
struct TourGraph {
  int nodes = 0;
  std::vector<TourEdge> edges;
};

// Errors: kInvalidArgument naming the edge if it leads to no node, from a node to itself, between
// nodes that have an edge already, or if its cost is not finite and >= 0; or without any node.
absl::Status Validate(const TourGraph& graph);

// Points of a width x height lattice, row by row.
std::vector<Cell> LatticePoints(int width, int height);

// The survey's mesh graph, [LHR] Eq. (2): node i is points[i], and edges lead to those of its eight
// neighbours on the lattice that are points too. `spacing_m` is alpha d_res.
// REQUIRES: no point twice. Cost: O(points log points).
TourGraph MeshGraph(std::span<const Cell> points, double spacing_m);

}  // namespace plumescout
