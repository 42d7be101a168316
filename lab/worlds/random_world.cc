// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/random_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "core/grid/distance_field.h"
#include "core/grid/flood.h"
#include "core/grid/grid_search.h"
#include "core/grid/neighbours.h"
#include "core/grid/ray.h"
#include "core/occupancy/free_space.h"
#include "core/types/options.h"
#include "core/types/rng.h"
#include "lab/worlds/fill.h"

namespace plumescout::lab {
namespace {

constexpr double kResolution_m = 0.1;
constexpr int kWidth_cells = 160;
constexpr int kHeight_cells = 200;
constexpr int kWall_cells = 2;
constexpr int kContainers = 14;
constexpr int kContainerLong_cells = 24;
constexpr int kContainerShort_cells = 12;
constexpr int kMinDoor_cells = 10;
constexpr int kMaxDoor_cells = 14;
constexpr int kDoorsPerWall = 2;
constexpr double kKnownShare = 0.6;
constexpr int kBeams = 720;
constexpr double kMinRange_m = 6.0;
constexpr double kMaxRange_m = 8.0;
constexpr double kScanSpacing_m = 1.0;  // of way driven between scans
constexpr int kMinFrontier_cells = 8;
// Fewer free cells are a hall whose partitions shut the robot in.
constexpr int kMinFree_cells = 8000;
constexpr int kPlumes = 3;

int Between(Rng& rng, int low, int high) {
  return low + static_cast<int>(rng.Below(static_cast<std::uint64_t>(high - low + 1)));
}

// A wall along the whole of one axis, with doors.
void BuildWall(Grid<CellState>& hall, bool along_x, int at, Rng& rng) {
  const int length = along_x ? hall.width() : hall.height();
  const auto stretch = [&](int from, int extent) {
    return along_x ? CellRect::Sized({from, at}, extent, kWall_cells)
                   : CellRect::Sized({at, from}, kWall_cells, extent);
  };
  Fill(stretch(0, length), CellState::kOccupied, hall);
  for (int door = 0; door < kDoorsPerWall; ++door) {
    const int width = Between(rng, kMinDoor_cells, kMaxDoor_cells);
    const int from = Between(rng, kWall_cells, length - kWall_cells - width);
    Fill(stretch(from, width), CellState::kFree, hall);
  }
}

Grid<CellState> BuildHall(Rng& rng) {
  GridGeometry geometry;
  geometry.resolution_m = kResolution_m;
  geometry.width = kWidth_cells;
  geometry.height = kHeight_cells;
  Grid<CellState> hall(geometry, CellState::kFree);
  BuildWall(hall, true, Between(rng, 50, 75), rng);
  BuildWall(hall, true, Between(rng, 120, 150), rng);
  BuildWall(hall, false, Between(rng, 55, 105), rng);
  for (int i = 0; i < kContainers; ++i) {
    const bool turned = rng.Below(2) == 0;
    const int width = turned ? kContainerShort_cells : kContainerLong_cells;
    const int height = turned ? kContainerLong_cells : kContainerShort_cells;
    const int x = Between(rng, 0, kWidth_cells - width);
    const int y = Between(rng, 0, kHeight_cells - height);
    Fill(CellRect::Sized({x, y}, width, height), CellState::kOccupied, hall);
  }
  Fill({{0, 0}, {kWidth_cells, 1}}, CellState::kOccupied, hall);
  Fill({{0, kHeight_cells - 1}, {kWidth_cells, kHeight_cells}}, CellState::kOccupied, hall);
  Fill({{0, 0}, {1, kHeight_cells}}, CellState::kOccupied, hall);
  Fill({{kWidth_cells - 1, 0}, {kWidth_cells, kHeight_cells}}, CellState::kOccupied, hall);
  return hall;
}

// Marks what a lidar at the centre of `at` sees.
void Scan(const Grid<CellState>& hall, Cell at, double range_m, Grid<CellState>& known) {
  const Point2 from = hall.geometry().Center(at);
  for (int beam = 0; beam < kBeams; ++beam) {
    const double bearing_rad = 2.0 * std::numbers::pi * beam / kBeams;
    const Point2 to{from.x_m + range_m * std::cos(bearing_rad),
                    from.y_m + range_m * std::sin(bearing_rad)};
    WalkSegment(hall.geometry(), from, to, [&](Cell cell, double length_cells) {
      if (!hall.Contains(cell)) return false;
      if (length_cells > 0.0) known[cell] = hall[cell];
      return hall[cell] != CellState::kOccupied;
    });
  }
}

bool TouchesUnknown(const Grid<CellState>& known, Cell cell) {
  return std::any_of(kNeighbours8.begin(), kNeighbours8.end(), [&](Cell offset) {
    return known.At(Shifted(cell, offset), CellState::kOccupied) == CellState::kUnknown;
  });
}

// The way to the nearest traversable cell beside the unknown that is not the robot's own.
std::vector<Cell> WayToNearestFrontier(const Grid<CellState>& known,
                                       const Grid<std::uint8_t>& traversable, Cell robot) {
  const Grid<double> travel_m = TravelDistances_m(traversable, std::vector<Cell>{robot});
  std::optional<Cell> nearest;
  for (std::size_t i = 0; i < travel_m.size(); ++i) {
    const Cell cell = travel_m.geometry().CellAtIndex(i);
    if (travel_m[i] == kUnreached_m || cell == robot || !TouchesUnknown(known, cell)) continue;
    if (!nearest || travel_m[i] < travel_m[*nearest]) nearest = cell;
  }
  return nearest ? ShortestPath(travel_m, *nearest) : std::vector<Cell>{};
}

struct Exploration {
  Grid<CellState> known;
  Grid<std::uint8_t> traversable;
  std::vector<Cell> driven;  // the robot stands on the last
};

// Share of the cells marked in `reachable` that are known.
double KnownShare(const Grid<std::uint8_t>& reachable, const Grid<CellState>& known) {
  double cells = 0.0;
  double found = 0.0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (reachable[i] == 0) continue;
    cells += 1.0;
    if (known[i] != CellState::kUnknown) found += 1.0;
  }
  return cells > 0.0 ? found / cells : 1.0;
}

Exploration Explore(const Grid<CellState>& hall, Rng& rng) {
  const double inflation_m = OccupancyOptions{}.inflation_radius_m;
  const Grid<std::uint8_t> truly_traversable = TraversableCells(hall, inflation_m);
  Cell start;
  do {
    start = hall.geometry().CellAtIndex(rng.Below(hall.size()));
  } while (truly_traversable[start] == 0);
  const Grid<std::uint8_t> reachable = ReachableCells(truly_traversable, {start});
  const double range_m = rng.Uniform(kMinRange_m, kMaxRange_m);
  const int stride = static_cast<int>(kScanSpacing_m / kResolution_m);

  Exploration result{Grid<CellState>(hall.geometry(), CellState::kUnknown), {}, {start}};
  Scan(hall, start, range_m, result.known);
  result.traversable = TraversableCells(result.known, inflation_m);
  while (KnownShare(reachable, result.known) < kKnownShare) {
    const std::vector<Cell> way =
        WayToNearestFrontier(result.known, result.traversable, result.driven.back());
    if (way.empty()) break;
    for (std::size_t i = 1; i < way.size(); ++i) {
      result.driven.push_back(way[i]);
      if (i % static_cast<std::size_t>(stride) == 0 || i + 1 == way.size()) {
        Scan(hall, way[i], range_m, result.known);
      }
    }
    result.traversable = TraversableCells(result.known, inflation_m);
  }
  return result;
}

// Drifting Gaussian plumes over the known free cells, walls ignored.
Grid<float> PlumeMean_ppm(const Grid<CellState>& known, Rng& rng) {
  constexpr double kAlong_m = 3.0;
  constexpr double kAcross_m = 0.8;
  struct Plume {
    Point2 source;
    double bearing_rad, peak_ppm;
  };
  std::array<Plume, kPlumes> plumes{};
  for (Plume& plume : plumes) {
    plume = {{rng.Uniform(1.0, 15.0), rng.Uniform(1.0, 19.0)},
             rng.Uniform(-std::numbers::pi, std::numbers::pi),
             rng.Uniform(10.0, 60.0)};
  }
  Grid<float> mean_ppm(known.geometry(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] != CellState::kFree) continue;
    const Point2 at = known.geometry().Center(known.geometry().CellAtIndex(i));
    double sum_ppm = 0.0;
    for (const Plume& plume : plumes) {
      const double dx = at.x_m - plume.source.x_m;
      const double dy = at.y_m - plume.source.y_m;
      const double along = dx * std::cos(plume.bearing_rad) + dy * std::sin(plume.bearing_rad);
      const double across = dy * std::cos(plume.bearing_rad) - dx * std::sin(plume.bearing_rad);
      const double u = along / (along > 0.0 ? kAlong_m : kAcross_m);
      const double v = across / kAcross_m;
      sum_ppm += plume.peak_ppm * std::exp(-0.5 * (u * u + v * v));
    }
    mean_ppm[i] = static_cast<float>(sum_ppm);
  }
  return mean_ppm;
}

// From that of a measured cell to that of an open lattice, with the distance from the way driven.
Grid<float> Variance_ppm2(const Exploration& exploration, const GasOptions& gas) {
  constexpr double kMeasured_ppm2 = 0.075;
  constexpr double kReach_m = 1.5;
  Grid<std::uint8_t> driven(exploration.known.geometry(), 0);
  for (const Cell cell : exploration.driven) driven[cell] = 1;
  const Grid<std::int32_t> distances = SquaredDistances_cells2(driven);
  const double open_ppm2 = OpenLatticeVariance_ppm2(gas);
  Grid<float> variance_ppm2(driven.geometry(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < driven.size(); ++i) {
    if (exploration.known[i] != CellState::kFree) continue;
    const double distance_m = std::sqrt(static_cast<double>(distances[i])) * kResolution_m;
    const double share = std::exp(-distance_m / kReach_m);
    variance_ppm2[i] = static_cast<float>(kMeasured_ppm2 * share + open_ppm2 * (1.0 - share));
  }
  return variance_ppm2;
}

// The cells of one cluster of traversable cells beside the unknown.
struct Cluster {
  std::vector<Cell> cells;
};

std::vector<Cluster> FrontierClusters(const Exploration& exploration) {
  const Grid<std::uint8_t> reachable =
      ReachableCells(exploration.traversable, {exploration.driven.back()});
  Grid<std::uint8_t> edge(reachable.geometry(), 0);
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const Cell cell = edge.geometry().CellAtIndex(i);
    edge[i] = reachable[i] != 0 && TouchesUnknown(exploration.known, cell) ? 1 : 0;
  }
  const Components components = ConnectedComponents(edge, Connectivity::kEight);
  std::vector<Cluster> clusters(components.sizes.size());
  for (std::size_t i = 0; i < edge.size(); ++i) {
    if (components.label[i] == Components::kNone) continue;
    clusters[static_cast<std::size_t>(components.label[i])].cells.push_back(
        edge.geometry().CellAtIndex(i));
  }
  std::erase_if(clusters, [&](const Cluster& cluster) {
    return cluster.cells.size() < kMinFrontier_cells ||
           std::count(cluster.cells.begin(), cluster.cells.end(), exploration.driven.back()) > 0;
  });
  std::stable_sort(clusters.begin(), clusters.end(), [](const Cluster& a, const Cluster& b) {
    return a.cells.size() > b.cells.size();
  });
  return clusters;
}

Goal GoalOf(const Cluster& cluster, const GridGeometry& geometry) {
  Goal goal;
  goal.cell = cluster.cells[cluster.cells.size() / 2];
  goal.position = geometry.Center(goal.cell);
  goal.centroid = goal.position;
  goal.frontier_cells = static_cast<int>(cluster.cells.size());
  return goal;
}

Belief MakeBelief(const Exploration& exploration, const RobotId& robot, Rng& rng) {
  Belief belief;
  belief.revision = 1;
  const auto options = std::make_shared<MissionOptions>();
  belief.options = options;
  belief.occupancy = std::make_shared<const Grid<CellState>>(exploration.known);
  belief.traversable = std::make_shared<const Grid<std::uint8_t>>(exploration.traversable);
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(PlumeMean_ppm(exploration.known, rng));
  belief.gas_variance_ppm2 =
      std::make_shared<const Grid<float>>(Variance_ppm2(exploration, options->gas));
  const Point2 at = belief.geometry().Center(exploration.driven.back());
  RobotRecord& record = belief.robots[robot];
  record.state.id = robot;
  record.state.has_pose = true;
  record.state.pose = {at.x_m, at.y_m, 0.0};
  return belief;
}

}  // namespace

RandomWorld MakeRandomWorld(std::uint64_t seed, int goal_count) {
  Rng rng(seed);
  while (true) {
    const Exploration exploration = Explore(BuildHall(rng), rng);
    const std::vector<Cluster> clusters = FrontierClusters(exploration);
    if (exploration.traversable[exploration.driven.back()] == 0) continue;
    const auto& known = exploration.known.values();
    if (std::count(known.begin(), known.end(), CellState::kFree) < kMinFree_cells) continue;
    if (clusters.size() < static_cast<std::size_t>(goal_count)) continue;
    RandomWorld world;
    world.robot = "robot";
    world.belief = MakeBelief(exploration, world.robot, rng);
    for (int i = 0; i < goal_count; ++i) {
      world.goals.push_back(GoalOf(clusters[static_cast<std::size_t>(i)], world.belief.geometry()));
    }
    return world;
  }
}

}  // namespace plumescout::lab
