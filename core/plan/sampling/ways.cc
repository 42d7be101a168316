// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling/ways.h"

#include <cstddef>
#include <optional>
#include <utility>

#include "core/grid/grid_search.h"
#include "core/grid/ray.h"

namespace plumescout {
namespace {

// The polyline through some of `points` in their order that leaves out what is in clear sight.
std::vector<Point2> PulledTight(const Grid<std::uint8_t>& passable,
                                const std::vector<Point2>& points) {
  std::vector<Point2> tight = {points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    if (!IsClear(passable, tight.back(), points[i + 1])) tight.push_back(points[i]);
  }
  tight.push_back(points.back());
  return tight;
}

Way WayAlong(std::vector<Point2> vertices) {
  Way way{std::move(vertices), 0.0};
  for (std::size_t i = 1; i < way.vertices.size(); ++i) {
    way.length_m += Distance_m(way.vertices[i - 1], way.vertices[i]);
  }
  return way;
}

}  // namespace

bool IsClear(const Grid<std::uint8_t>& passable, Point2 from, Point2 to) {
  return WalkSegment(passable.geometry(), from, to,
                     [&](Cell cell, double) { return passable.At(cell, 0) != 0; });
}

std::vector<Way> WaysFrom(const Grid<std::uint8_t>& passable, Point2 from,
                          const std::vector<Point2>& places) {
  const GridGeometry& geometry = passable.geometry();
  std::optional<Grid<double>> travel_m;  // searched for the first that is out of sight
  std::vector<Way> ways;
  for (const Point2 place : places) {
    if (IsClear(passable, from, place)) {
      ways.push_back(WayAlong({from, place}));
      continue;
    }
    if (!travel_m) {
      travel_m = TravelDistances_m(passable, std::vector<Cell>{geometry.CellAt(from)});
    }
    std::vector<Point2> points;
    for (const Cell cell : ShortestPath(*travel_m, geometry.CellAt(place))) {
      points.push_back(geometry.Center(cell));
    }
    if (points.empty()) {
      ways.emplace_back();
      continue;
    }
    points.front() = from;
    points.back() = place;
    ways.push_back(WayAlong(PulledTight(passable, points)));
  }
  return ways;
}

}  // namespace plumescout
