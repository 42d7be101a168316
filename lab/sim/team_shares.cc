// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/team_shares.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/grid/ray.h"

namespace plumescout::lab {
namespace {

constexpr int kBeams = 180;
constexpr double kLookPeriod_s = 0.5;

struct Look {
  double time_s = 0.0;
  std::size_t robot = 0;
  Point2 place;
};

// In the order of time, and of robots at one time.
std::vector<Look> LooksOf(const TeamResult& team) {
  std::vector<Look> looks;
  for (std::size_t i = 0; i < team.robots.size(); ++i) {
    double next_s = 0.0;
    for (const DrivenPose& at : team.robots[i].path) {
      if (at.time_s < next_s) continue;
      next_s = at.time_s + kLookPeriod_s;
      looks.push_back({at.time_s, i, at.pose.position()});
    }
  }
  std::stable_sort(looks.begin(), looks.end(),
                   [](const Look& a, const Look& b) { return a.time_s < b.time_s; });
  return looks;
}

// How many free cells each robot saw first.
std::vector<double> CellsSeenFirst(const TeamResult& team, const Grid<CellState>& truth,
                                   double range_m) {
  std::vector<double> cells(team.robots.size(), 0.0);
  Grid<std::uint8_t> seen(truth.geometry());
  for (const Look& look : LooksOf(team)) {
    for (int beam = 0; beam < kBeams; ++beam) {
      const double angle_rad = 2.0 * M_PI * beam / kBeams;
      const Point2 end{look.place.x_m + range_m * std::cos(angle_rad),
                       look.place.y_m + range_m * std::sin(angle_rad)};
      WalkSegment(truth.geometry(), look.place, end, [&](Cell cell, double) {
        if (truth.At(cell, CellState::kOccupied) != CellState::kFree) return false;
        if (seen[cell] == 0) cells[look.robot] += 1.0;
        seen[cell] = 1;
        return true;
      });
    }
  }
  return cells;
}

double ShareOf(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

}  // namespace

std::vector<RobotShares> SharesOf(const TeamResult& team, const SceneWorld& world, double range_m) {
  const std::vector<double> cells = CellsSeenFirst(team, world.occupancy(), range_m);
  double all_cells = 0.0;
  double all_readings = 0.0;
  double all_m = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    all_cells += cells[i];
    all_readings += static_cast<double>(team.robots[i].readings_applied);
    all_m += team.robots[i].distance_m;
  }
  std::vector<RobotShares> shares;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const EpisodeResult& robot = team.robots[i];
    shares.push_back({ShareOf(cells[i], all_cells),
                      ShareOf(static_cast<double>(robot.readings_applied), all_readings),
                      ShareOf(robot.distance_m, all_m)});
  }
  return shares;
}

}  // namespace plumescout::lab
