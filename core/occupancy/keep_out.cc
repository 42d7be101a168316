// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/occupancy/keep_out.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/grid/ray.h"

namespace plumescout {
namespace {

// Where the boundary crosses the horizontal line, ascending. An edge has its lower end and lacks
// its upper one, so the number is even.
void FindCrossings_m(const Polygon& area, double y_m, std::vector<double>& crossings_m) {
  crossings_m.clear();
  for (std::size_t i = 0; i < area.vertices.size(); ++i) {
    const Point2 a = area.vertices[i];
    const Point2 b = area.vertices[(i + 1) % area.vertices.size()];
    if ((a.y_m <= y_m) == (b.y_m <= y_m)) continue;
    crossings_m.push_back(std::lerp(a.x_m, b.x_m, (y_m - a.y_m) / (b.y_m - a.y_m)));
  }
  std::sort(crossings_m.begin(), crossings_m.end());
}

// The first of `count` columns or rows whose centre lies at `offset_m` from the origin or beyond;
// `count` if none does.
int FirstFrom(double offset_m, double resolution_m, int count) {
  constexpr double kCentre = 0.5;
  const double first = std::ceil(offset_m / resolution_m - kCentre);
  return static_cast<int>(std::clamp(first, 0.0, static_cast<double>(count)));
}
int ColumnFrom(const GridGeometry& geometry, double x_m) {
  return FirstFrom(x_m - geometry.origin_x_m, geometry.resolution_m, geometry.width);
}
int RowFrom(const GridGeometry& geometry, double y_m) {
  return FirstFrom(y_m - geometry.origin_y_m, geometry.resolution_m, geometry.height);
}

// Writes `value` to the cells of all areas.
void Fill(const std::vector<Polygon>& areas, std::uint8_t value, Grid<std::uint8_t>& cells) {
  const GridGeometry& geometry = cells.geometry();
  std::vector<double> crossings_m;
  for (const Polygon& area : areas) {
    const auto [south, north] =
        std::minmax_element(area.vertices.begin(), area.vertices.end(),
                            [](const Point2& a, const Point2& b) { return a.y_m < b.y_m; });
    // One row more at either end: rounding may have put its centre inside.
    const int end_row = std::min(RowFrom(geometry, north->y_m) + 1, geometry.height);
    for (int y = std::max(RowFrom(geometry, south->y_m) - 1, 0); y < end_row; ++y) {
      FindCrossings_m(area, geometry.Center({0, y}).y_m, crossings_m);
      for (std::size_t i = 0; i + 1 < crossings_m.size(); i += 2) {
        const int end = ColumnFrom(geometry, crossings_m[i + 1]);
        for (int x = ColumnFrom(geometry, crossings_m[i]); x < end; ++x) cells[Cell{x, y}] = value;
      }
    }
  }
}

}  // namespace

void CloseKeptOut(const std::vector<Polygon>& areas, Grid<std::uint8_t>& traversable) {
  Fill(areas, 0, traversable);
}

Grid<std::uint8_t> KeptOutCells(const std::vector<Polygon>& areas, const GridGeometry& geometry) {
  Grid<std::uint8_t> cells(geometry);
  Fill(areas, 1, cells);
  return cells;
}

bool IsKeptOut(const std::vector<Polygon>& areas, Point2 place) {
  std::vector<double> crossings_m;
  return std::any_of(areas.begin(), areas.end(), [&](const Polygon& area) {
    FindCrossings_m(area, place.y_m, crossings_m);
    const auto beyond = std::upper_bound(crossings_m.begin(), crossings_m.end(), place.x_m);
    return (beyond - crossings_m.begin()) % 2 != 0;
  });
}

std::optional<Cell> FirstKeptOut(const Grid<std::uint8_t>& kept_out,
                                 const std::vector<Point2>& way) {
  if (way.empty()) return std::nullopt;
  const GridGeometry& geometry = kept_out.geometry();
  const auto is_kept_out = [&](Cell cell) { return kept_out.At(cell, 0) != 0; };
  bool has_left = !is_kept_out(geometry.CellAt(way.front()));
  std::optional<Cell> entered;
  const auto enter = [&](Cell cell, double) {
    if (!is_kept_out(cell)) {
      has_left = true;
    } else if (has_left) {
      entered = cell;
    }
    return !entered.has_value();
  };
  for (std::size_t i = 1; i < way.size() && !entered; ++i) {
    WalkSegment(geometry, way[i - 1], way[i], enter);
  }
  const Cell end = geometry.CellAt(way.back());
  if (!entered && is_kept_out(end)) entered = end;
  return entered;
}

}  // namespace plumescout
