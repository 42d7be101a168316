// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/bench_world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/grid/ray.h"
#include "core/types/rng.h"

namespace plumescout::lab {
namespace {

constexpr int kRoom_cells = 40;
constexpr int kDoor_cells = 10;
constexpr int kBox_cells = 6;
constexpr int kBoxesPerRoom = 2;
constexpr int kBeams = 360;
constexpr double kMaxRange_m = 8.0;

// Walls on every kRoom_cells-th line, one door in each wall of each room.
bool IsWall(Cell cell, int door) {
  const bool on_x = cell.x % kRoom_cells == 0;
  const bool on_y = cell.y % kRoom_cells == 0;
  const auto in_door = [door](int along) {
    const int offset = along % kRoom_cells - door;
    return offset >= 0 && offset < kDoor_cells;
  };
  return (on_x && (on_y || !in_door(cell.y))) || (on_y && (on_x || !in_door(cell.x)));
}

}  // namespace

Grid<std::uint8_t> MakeBuilding(int width, int height, std::uint64_t seed) {
  Rng rng(seed);
  Grid<std::uint8_t> walls(GridGeometry{0.0, 0.0, 0.1, width, height});
  const int door = kBox_cells + static_cast<int>(rng.Below(kRoom_cells / 2));
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Cell cell = walls.geometry().CellAtIndex(i);
    const bool outer = cell.x == 0 || cell.y == 0 || cell.x == width - 1 || cell.y == height - 1;
    walls[i] = outer || IsWall(cell, door) ? 1 : 0;
  }
  const int boxes = kBoxesPerRoom * (width / kRoom_cells) * (height / kRoom_cells);
  for (int box = 0; box < boxes; ++box) {
    const Cell corner = walls.geometry().CellAtIndex(rng.Below(walls.size()));
    for (int y = 0; y < kBox_cells; ++y) {
      for (int x = 0; x < kBox_cells; ++x) {
        const Cell cell = {corner.x + x, corner.y + y};
        if (walls.Contains(cell)) walls[cell] = 1;
      }
    }
  }
  return walls;
}

Scan ScanBuilding(const Grid<std::uint8_t>& walls, const Pose2& pose) {
  Scan scan = {-M_PI, 2.0 * M_PI / kBeams, kMaxRange_m, {}};
  for (int beam = 0; beam < kBeams; ++beam) {
    const double angle_rad = pose.yaw_rad + scan.start_angle_rad + beam * scan.angle_step_rad;
    const Point2 end = {pose.x_m + kMaxRange_m * std::cos(angle_rad),
                        pose.y_m + kMaxRange_m * std::sin(angle_rad)};
    double range_cells = 0.0;
    const bool clear =
        WalkSegment(walls.geometry(), pose.position(), end, [&](Cell cell, double length_cells) {
          if (walls.At(cell, 1) != 0) return false;
          range_cells += length_cells;
          return true;
        });
    // Half a cell into the wall, so that the hit lies in it whatever the angle.
    const double range_m = (range_cells + 0.5) * walls.geometry().resolution_m;
    scan.ranges_m.push_back(clear ? std::numeric_limits<float>::infinity()
                                  : static_cast<float>(std::min(range_m, kMaxRange_m)));
  }
  return scan;
}

std::vector<Pose2> FreePoses(const Grid<std::uint8_t>& walls, int count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Pose2> poses;
  while (static_cast<int>(poses.size()) < count) {
    const std::size_t index = rng.Below(walls.size());
    if (walls[index] != 0) continue;
    const Point2 center = walls.geometry().Center(walls.geometry().CellAtIndex(index));
    poses.push_back({center.x_m, center.y_m, rng.Uniform(-M_PI, M_PI)});
  }
  return poses;
}

void DriveOn(const Grid<std::uint8_t>& walls, double step_m, double clear_m, Rng& rng,
             Pose2& pose) {
  constexpr int kMostTurns = 50;
  constexpr double kLook_m = 0.1;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    bool blocked = false;
    for (double ahead_m = kLook_m; ahead_m < step_m + clear_m; ahead_m += kLook_m) {
      const Point2 place = PlaceOnRobot(pose, {ahead_m, 0.0});
      blocked = blocked || walls.At(walls.geometry().CellAt(place), 1) != 0;
    }
    if (!blocked) {
      const Point2 next = PlaceOnRobot(pose, {step_m, 0.0});
      pose = {next.x_m, next.y_m, pose.yaw_rad};
      return;
    }
    pose.yaw_rad = rng.Uniform(-M_PI, M_PI);
  }
}

}  // namespace plumescout::lab
