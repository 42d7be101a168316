// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumescout::testing {

// A square map of square rooms with doors, turned by an angle: 1 where a cell is free.
inline std::vector<std::uint8_t> RotatedRooms(std::size_t side, double angle_deg) {
  constexpr double kRoom = 30.0;
  constexpr double kWall = 3.0;
  constexpr double kDoor = 6.0;
  const double c = std::cos(angle_deg * M_PI / 180.0);
  const double s = std::sin(angle_deg * M_PI / 180.0);
  const auto into_room = [](double u) { return u - kRoom * std::floor(u / kRoom); };
  std::vector<std::uint8_t> active;
  for (std::size_t i = 0; i < side * side; ++i) {
    const auto x = static_cast<double>(i % side);
    const auto y = static_cast<double>(i / side);
    const double u = into_room(c * x + s * y);
    const double v = into_room(c * y - s * x);
    const bool in_door = (u >= 12.0 && u < 12.0 + kDoor) || (v >= 12.0 && v < 12.0 + kDoor);
    active.push_back((u < kWall || v < kWall) && !in_door ? 0 : 1);
  }
  return active;
}

}  // namespace plumescout::testing
