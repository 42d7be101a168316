// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/sampled_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace plumescout {

std::int64_t SampledCells::Index(double coordinate_m) const {
  return static_cast<std::int64_t>(std::floor(coordinate_m / resolution_m_));
}

double SampledCells::Middle_m(std::int64_t index) const {
  constexpr double kMiddle = 0.5;
  return (static_cast<double>(index) + kMiddle) * resolution_m_;
}

SampledCells::Column::const_iterator SampledCells::FirstFrom(std::int64_t y, const Column& column) {
  return std::lower_bound(column.begin(), column.end(), y,
                          [](const Sampled& cell, std::int64_t from) { return cell.y < from; });
}

bool SampledCells::Add(std::int64_t time_ns, Point2 place) {
  const std::int64_t y = Index(place.y_m);
  Column& column = columns_[Index(place.x_m)];
  const auto found = column.begin() + (FirstFrom(y, column) - column.cbegin());
  if (found == column.end() || found->y != y) {
    column.insert(found, {y, time_ns});
    return true;
  }
  found->newest_ns = std::max(found->newest_ns, time_ns);
  return false;
}

Grid<std::uint8_t> SampledCells::On(const GridGeometry& geometry) const {
  Grid<std::uint8_t> raster(geometry, 0);
  for (const auto& [x, column] : columns_) {
    for (const Sampled& sampled : column) {
      const Cell cell = geometry.CellAt(MiddleOf(x, sampled.y));
      if (geometry.Contains(cell)) raster[cell] = 1;
    }
  }
  return raster;
}

// Column by column from the place on, to both sides, until none can hold a nearer cell.
std::optional<NearestReading> SampledCells::Nearest(Point2 place) const {
  std::optional<NearestReading> nearest;
  const auto take = [&](std::int64_t x, const Sampled& cell) {
    NearestReading reading{Distance_m(place, MiddleOf(x, cell.y)), std::nullopt};
    if (cell.newest_ns != kNoTime_ns) reading.time_ns = cell.newest_ns;
    if (!nearest || reading.distance_m < nearest->distance_m ||
        (reading.distance_m == nearest->distance_m && reading.time_ns > nearest->time_ns)) {
      nearest = reading;
    }
  };
  const std::int64_t y = Index(place.y_m);
  const auto look = [&](const std::pair<const std::int64_t, Column>& entry) {
    const auto& [x, column] = entry;
    if (nearest && std::abs(Middle_m(x) - place.x_m) > nearest->distance_m) return false;
    const auto from = FirstFrom(y, column);
    if (from != column.end()) take(x, *from);
    if (from != column.begin()) take(x, *std::prev(from));
    return true;
  };
  const auto middle = columns_.lower_bound(Index(place.x_m));
  for (auto it = middle; it != columns_.end() && look(*it); ++it) {
  }
  for (auto it = middle; it != columns_.begin() && look(*std::prev(it)); --it) {
  }
  return nearest;
}

}  // namespace plumescout
