// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/grid_search.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace plumescout {
namespace {

TravelSearch<double> SearchOver(const Grid<std::uint8_t>& passable, Connectivity connectivity) {
  return {passable.geometry(), connectivity,
          [&passable](std::size_t index) { return passable[index] != 0; }};
}

}  // namespace

Grid<double> TravelDistances_m(const Grid<std::uint8_t>& passable,
                               const std::vector<SearchSource>& sources,
                               Connectivity connectivity) {
  TravelSearch<double> search = SearchOver(passable, connectivity);
  search.Run(sources);
  return search.Field();
}

Grid<double> TravelDistances_m(const Grid<std::uint8_t>& passable, const std::vector<Cell>& starts,
                               Connectivity connectivity) {
  std::vector<SearchSource> sources;
  sources.reserve(starts.size());
  for (const Cell start : starts) sources.push_back({start, 0.0});
  return TravelDistances_m(passable, sources, connectivity);
}

std::vector<Cell> ShortestPath(const Grid<double>& travel_m, Cell goal, Connectivity connectivity) {
  const auto travel = [&travel_m](Cell cell) { return travel_m.At(cell, kUnreached_m); };
  if (travel(goal) == kUnreached_m) return {};
  std::vector<Cell> path = {goal};
  while (const std::optional<Cell> from = Predecessor<double>(
             path.back(), travel_m.geometry().resolution_m, connectivity, travel)) {
    path.push_back(*from);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<Cell> PathToNearest(const Grid<std::uint8_t>& passable,
                                const Grid<std::uint8_t>& targets, Cell start) {
  if (!passable.Contains(start)) return {};
  TravelSearch<double> search = SearchOver(passable, Connectivity::kEightNoCornerCut);
  search.Open(search.IndexOf(start));
  std::optional<Cell> nearest;
  double nearest_m = kUnreached_m;
  search.Run({{start, 0.0}}, [&] {
    search.ForEachOfLevel([&](int index, double travel_m) {
      const Cell cell = search.CellAt(index);
      if (targets[cell] == 0 || travel_m > nearest_m) return;
      if (travel_m == nearest_m &&
          targets.geometry().Index(*nearest) < targets.geometry().Index(cell)) {
        return;
      }
      nearest = cell;
      nearest_m = travel_m;
    });
    return nearest.has_value();
  });
  return nearest ? search.WayTo(*nearest) : std::vector<Cell>{};
}

double PathLength_m(const std::vector<Cell>& path, double resolution_m) {
  double length_cells = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length_cells += StepLength_cells({path[i].x - path[i - 1].x, path[i].y - path[i - 1].y});
  }
  return length_cells * resolution_m;
}

}  // namespace plumescout
