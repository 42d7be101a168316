// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/mac_field.h"

#include <algorithm>
#include <cmath>

namespace plumescout::lab {
namespace {

double MaxMagnitude(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

MacField::MacField(const GridGeometry& geometry)
    : geometry_(geometry),
      first_v_(UFace(0, geometry.height)),
      values_mps_(VFace(0, geometry.height + 1)) {}

Velocity MacField::AtCenter(Cell cell) const {
  return {0.5 * (u(cell.x, cell.y) + u(cell.x + 1, cell.y)),
          0.5 * (v(cell.x, cell.y) + v(cell.x, cell.y + 1))};
}

Velocity MacField::At(Point2 point) const {
  const Cell cell = geometry_.CellAt(point);
  if (!geometry_.Contains(cell)) return {};
  const double east = (point.x_m - geometry_.origin_x_m) / geometry_.resolution_m - cell.x;
  const double north = (point.y_m - geometry_.origin_y_m) / geometry_.resolution_m - cell.y;
  return {(1.0 - east) * u(cell.x, cell.y) + east * u(cell.x + 1, cell.y),
          (1.0 - north) * v(cell.x, cell.y) + north * v(cell.x, cell.y + 1)};
}

void MacField::AddScaled(const MacField& other, double factor) {
  for (std::size_t i = 0; i < values_mps_.size(); ++i) {
    values_mps_[i] += factor * other.values_mps_[i];
  }
}

Velocity MacField::MaxMagnitudes() const {
  return {MaxMagnitude(values().first(first_v_)), MaxMagnitude(values().subspan(first_v_))};
}

double MacField::FastestCell_mps() const {
  double fastest = 0.0;
  for (int y = 0; y < geometry_.height; ++y) {
    for (int x = 0; x < geometry_.width; ++x) {
      const double east = std::max(std::abs(u(x, y)), std::abs(u(x + 1, y)));
      const double north = std::max(std::abs(v(x, y)), std::abs(v(x, y + 1)));
      fastest = std::max(fastest, east + north);
    }
  }
  return fastest;
}

}  // namespace plumescout::lab
