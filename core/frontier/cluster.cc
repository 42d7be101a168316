// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/frontier/cluster.h"

#include <cstddef>

#include "core/grid/neighbours.h"

namespace plumescout {
namespace {

Point2 Centroid(const std::vector<Cell>& cells, const GridGeometry& geometry) {
  double sum_x_m = 0.0;
  double sum_y_m = 0.0;
  for (const Cell cell : cells) {
    const Point2 center = geometry.Center(cell);
    sum_x_m += center.x_m;
    sum_y_m += center.y_m;
  }
  const auto count = static_cast<double>(cells.size());
  return {sum_x_m / count, sum_y_m / count};
}

}  // namespace

Frontier TakeCluster(const GridGeometry& geometry, const ClusterRule& rule, int seed,
                     Padded<std::uint8_t>& cells) {
  Frontier frontier;
  frontier.kind = rule.kind;
  cells[seed] = rule.taken;
  frontier.cells.push_back(cells.CellAt(seed));
  const auto offsets = cells.NeighbourOffsets();
  for (std::size_t i = 0; i < frontier.cells.size(); ++i) {
    const Cell at = frontier.cells[i];
    const int cell = cells.IndexOf(at);
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      if (cells[cell + offsets[k]] != rule.waiting) continue;
      cells[cell + offsets[k]] = rule.taken;
      frontier.cells.push_back(Shifted(at, kNeighbours8[k]));
    }
  }
  frontier.centroid = Centroid(frontier.cells, geometry);
  frontier.too_small = frontier.cells.size() < static_cast<std::size_t>(rule.min_cells);
  return frontier;
}

}  // namespace plumescout
