// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/team_starts.h"

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "core/types/grid.h"

namespace plumescout::lab {
namespace {

// Free cells in the order in which a wave from `start` meets them, 4 neighbours.
std::vector<Cell> FreeCellsByTravel(const Grid<CellState>& occupancy, Cell start) {
  constexpr Cell kSteps[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  Grid<std::uint8_t> met(occupancy.geometry());
  std::vector<Cell> cells = {start};
  met[start] = 1;
  for (std::size_t next = 0; next < cells.size(); ++next) {
    for (const Cell step : kSteps) {
      const Cell cell{cells[next].x + step.x, cells[next].y + step.y};
      if (occupancy.At(cell, CellState::kOccupied) != CellState::kFree || met[cell] != 0) continue;
      met[cell] = 1;
      cells.push_back(cell);
    }
  }
  return cells;
}

}  // namespace

absl::StatusOr<std::vector<Pose2>> TeamStarts(const SceneWorld& world, int robots,
                                              double body_radius_m) {
  const Pose2 first = world.scene().start_pose;
  const GridGeometry& geometry = world.scene().geometry();
  std::vector<Pose2> starts = {first};
  for (const Cell cell : FreeCellsByTravel(world.occupancy(), geometry.CellAt(first.position()))) {
    if (static_cast<int>(starts.size()) == robots) break;
    const Point2 place = geometry.Center(cell);
    const bool clear = std::all_of(starts.begin(), starts.end(), [&](const Pose2& taken) {
      return Distance_m(taken.position(), place) >= kStartSpacing_m;
    });
    if (clear && !world.Collides(place, body_radius_m)) {
      starts.push_back({place.x_m, place.y_m, first.yaw_rad});
    }
  }
  if (static_cast<int>(starts.size()) == robots) return starts;
  return absl::InvalidArgumentError(absl::StrCat(
      "robots = ", robots, " do not fit into the scene: there is room for ", starts.size()));
}

std::vector<RobotId> TeamNames(const RobotId& first, int robots) {
  std::size_t stem = first.size();
  while (stem > 0 && std::isdigit(static_cast<unsigned char>(first[stem - 1])) != 0) --stem;
  std::int64_t number = 1;
  const bool counts = absl::SimpleAtoi(first.substr(stem), &number);
  const std::string prefix = counts ? first.substr(0, stem) : absl::StrCat(first, "-");
  std::vector<RobotId> names = {first};
  for (int i = 1; i < robots; ++i) names.push_back(absl::StrCat(prefix, number + i));
  return names;
}

}  // namespace plumescout::lab
