// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/one_lane_layout.h"

#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/rng.h"

namespace plumescout::lab {
namespace {

constexpr double kLane_m = 0.8;
constexpr double kThick_m = 0.2;
constexpr double kRoom_m = 3.0;  // both ways, within its walls
constexpr int kRoomsPerSide = 3;
constexpr double kLength_m = kThick_m + kRoomsPerSide * (kRoom_m + kThick_m);
constexpr double kSouth_m = kThick_m + kRoom_m + kThick_m / 2.0;  // middles of the corridor's walls
constexpr double kNorth_m = kSouth_m + kThick_m + kLane_m;
constexpr double kDepth_m = kNorth_m + kThick_m / 2.0 + kRoom_m + kThick_m;

double WestOf_m(int room) { return kThick_m + room * (kRoom_m + kThick_m); }

// The wall between the corridor and the rooms on one side of it, a door to each.
Wall CorridorWall(double y_m, Rng& rng) {
  constexpr int kPlaces = 15;  // of a door in a room's wall, 0.1 m apart
  Wall wall{{kThick_m, y_m}, {kLength_m - kThick_m, y_m}, kThick_m, {}};
  for (int room = 0; room < kRoomsPerSide; ++room) {
    const double along_m = 0.1 * static_cast<double>(rng.Below(kPlaces));
    wall.doors.push_back({WestOf_m(room) - kThick_m + 0.8 + along_m, kLane_m});
  }
  return wall;
}

Point2 MiddleOf(int room) {
  const bool north = room >= kRoomsPerSide;
  return {WestOf_m(room % kRoomsPerSide) + kRoom_m / 2.0,
          north ? kDepth_m - kThick_m - kRoom_m / 2.0 : kThick_m + kRoom_m / 2.0};
}

}  // namespace

Layout OneLaneLayout(std::uint64_t seed) {
  Rng rng(seed);
  Layout layout;
  layout.name = absl::StrCat("one_lane_", seed);
  layout.size_x_m = kLength_m;
  layout.size_y_m = kDepth_m;
  layout.border_m = kThick_m;
  layout.walls = {CorridorWall(kSouth_m, rng), CorridorWall(kNorth_m, rng)};
  for (int room = 1; room < kRoomsPerSide; ++room) {
    const double x_m = WestOf_m(room) - kThick_m / 2.0;
    layout.walls.push_back({{x_m, kThick_m}, {x_m, kSouth_m - kThick_m}, kThick_m, {}});
    layout.walls.push_back({{x_m, kNorth_m + kThick_m}, {x_m, kDepth_m - kThick_m}, kThick_m, {}});
  }
  const double low_m = kSouth_m + kThick_m / 2.0;
  layout.openings = {{Side::kWest, low_m, low_m + kLane_m, 0.5},
                     {Side::kEast, low_m, low_m + kLane_m, std::nullopt}};
  constexpr int kRooms = 2 * kRoomsPerSide;
  const int start = static_cast<int>(rng.Below(kRooms));
  for (int leak = 0; leak < 2; ++leak) {
    const int room = (start + 1 + static_cast<int>(rng.Below(2)) + 2 * leak) % kRooms;
    const Point2 place = MiddleOf(room);
    constexpr double kRate_ppm_per_s = 800.0;
    layout.sources.push_back(
        {leak, place.x_m + 0.05, place.y_m + 0.05, layout.sensor_height_m, kRate_ppm_per_s});
  }
  const Point2 place = MiddleOf(start);
  layout.start_pose = {place.x_m, place.y_m, 0.0};
  return layout;
}

}  // namespace plumescout::lab
