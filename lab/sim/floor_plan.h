// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/types/cell_rect.h"
#include "core/types/rng.h"

namespace plumescout::lab {

// Random floor plans, drawn in whole units so that they are the same on every machine and fit the
// cells of a raster exactly: the cells of their rectangles are units.
inline constexpr int kUnitsPerM = 5;  // a unit is 0.2 m: as thick as a wall

enum class RoomKind { kRoom, kHall, kCorridor };

struct Room {
  CellRect floor;
  RoomKind kind = RoomKind::kRoom;
};

// Gap in a partition between two rooms.
struct PlanDoor {
  int from = 0;  // first unit along the partition's axis
  int width = 0;
  int room_a = 0;  // indices into FloorPlan::rooms
  int room_b = 0;
};

// Wall one unit thick between rooms.
struct Partition {
  CellRect solid;         // as if it had no doors
  bool vertical = false;  // runs north; else east
  std::vector<PlanDoor> doors;
};

struct FloorPlan {
  int width = 0;  // of the building, with the outer wall of one unit all round
  int height = 0;
  std::vector<Room> rooms;
  std::vector<Partition> partitions;
};

// How a building is divided.
struct FloorPlanStyle {
  int largest_room_units2 = 1000;  // what is larger is divided, give or take a third
  double corridor_share = 0.5;     // of the divisions that have room for one
  double loop_share = 0.3;         // of the doors that no room needs to be reached
};

// Divides the building until its rooms are small enough, then cuts doors of 1.0 to 1.6 m, never at
// a wall's end, so that every room can be reached. Nothing if the draw left a room without a wall
// long enough for a door: then draw again. REQUIRES: at least 8 m on each side.
std::optional<FloorPlan> DrawFloorPlan(int width, int height, const FloorPlanStyle& style,
                                       Rng& rng);

// In square units.
inline int AreaOf(const CellRect& rect) { return rect.width() * rect.height(); }

// A whole number in [low, high]. REQUIRES: low <= high.
int DrawInt(Rng& rng, int low, int high);

}  // namespace plumescout::lab
