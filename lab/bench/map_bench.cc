// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
//
// What the map costs per scan and per plan, on a building of 160 x 200 cells half explored, each
// figure beside that of a plain way to do the same in the same run. CPU milliseconds, medians.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "core/belief/completeness.h"
#include "core/frontier/gas_frontier.h"
#include "core/frontier/occupancy_frontier.h"
#include "core/grid/distance_field.h"
#include "core/grid/grid_search.h"
#include "core/grid/mask.h"
#include "core/mission/mission.h"
#include "core/occupancy/free_space.h"
#include "core/occupancy/occupancy_grid.h"
#include "core/occupancy/scan_inserter.h"
#include "core/types/event.h"
#include "core/types/options.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/about/cpu_time.h"
#include "lab/bench/bench_program.h"
#include "lab/bench/bench_summary.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 200;
constexpr int kScanPlaces = 10;    // enough to see about half of the building
constexpr int kScansPerPlace = 4;  // three passes make a cell free
constexpr int kRepeats = 200;
constexpr int kSlowRepeats = 5;

// Bresenham's line from cell to cell, each cell once per scan, hits last: what is commonly done.
class BresenhamInserter {
 public:
  void Insert(const Pose2& pose, const Scan& scan, OccupancyGrid& grid) {
    const GridGeometry& geometry = grid.geometry();
    touched_.assign(geometry.size(), 0);
    const Cell from = geometry.CellAt(pose.position());
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const bool hit = std::isfinite(scan.ranges_m[i]);
      const double range_m = hit ? static_cast<double>(scan.ranges_m[i]) : scan.max_range_m;
      const double angle_rad =
          pose.yaw_rad + scan.start_angle_rad + static_cast<double>(i) * scan.angle_step_rad;
      const Cell to = geometry.CellAt(
          {pose.x_m + range_m * std::cos(angle_rad), pose.y_m + range_m * std::sin(angle_rad)});
      Line(from, to, geometry);
      if (hit) touched_[geometry.Index(to)] = 2;
    }
    for (std::size_t i = 0; i < touched_.size(); ++i) {
      if (touched_[i] == 1) grid.Add(i, grid.options().miss_log_odds);
      if (touched_[i] == 2) grid.Add(i, grid.options().hit_log_odds);
    }
  }

 private:
  void Line(Cell from, Cell to, const GridGeometry& geometry) {
    const int dx = std::abs(to.x - from.x);
    const int dy = -std::abs(to.y - from.y);
    const int step_x = from.x < to.x ? 1 : -1;
    const int step_y = from.y < to.y ? 1 : -1;
    int error = dx + dy;
    for (Cell cell = from;;) {
      std::uint8_t& touched = touched_[geometry.Index(cell)];
      touched = std::max<std::uint8_t>(touched, 1);
      if (cell == to) return;
      const int doubled = 2 * error;
      if (doubled >= dy) {
        error += dy;
        cell.x += step_x;
      }
      if (doubled <= dx) {
        error += dx;
        cell.y += step_y;
      }
    }
  }

  std::vector<std::uint8_t> touched_;
};

// Dijkstra with a binary heap.
Grid<double> HeapDistances_m(const Grid<std::uint8_t>& passable, Cell start) {
  Grid<double> distances(passable.geometry(), kUnreached_m);
  using Entry = std::pair<double, Cell>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  queue.push({0.0, start});
  const auto is_passable = [&](Cell c) { return passable.At(c, 0) != 0; };
  while (!queue.empty()) {
    const auto [distance_m, cell] = queue.top();
    queue.pop();
    if (distance_m >= distances[cell]) continue;
    distances[cell] = distance_m;
    for (const Cell offset : kNeighbours8) {
      if (!StepAllowed(cell, offset, is_passable)) continue;
      const double next_m =
          distance_m + StepLength_cells(offset) * passable.geometry().resolution_m;
      if (next_m < distances[Shifted(cell, offset)]) queue.push({next_m, Shifted(cell, offset)});
    }
  }
  return distances;
}

// Every cell against every set cell.
Grid<std::int32_t> AllPairsDistances_cells2(const Grid<std::uint8_t>& set) {
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (set[i] != 0) cells.push_back(set.geometry().CellAtIndex(i));
  }
  Grid<std::int32_t> distances(set.geometry(), kFarSquared);
  for (std::size_t i = 0; i < set.size(); ++i) {
    const Cell a = set.geometry().CellAtIndex(i);
    for (const Cell b : cells) {
      distances[i] = std::min(distances[i], (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
    }
  }
  return distances;
}

// The part of the grid that holds the building, so that figures are of 160 x 200 cells.
Grid<CellState> Cropped(const Grid<CellState>& states) {
  Grid<CellState> cropped(GridGeometry{0.0, 0.0, states.geometry().resolution_m, kWidth, kHeight});
  for (std::size_t i = 0; i < cropped.size(); ++i) {
    const Cell cell =
        states.geometry().CellAt(cropped.geometry().Center(cropped.geometry().CellAtIndex(i)));
    cropped[i] = states.At(cell, CellState::kUnknown);
  }
  return cropped;
}

struct World {
  OccupancyGrid grid{OccupancyOptions{}};
  std::vector<Pose2> poses;
  std::vector<Scan> scans;
  Grid<CellState> states;
  Grid<std::uint8_t> traversable;
  Cell start;
};

absl::Status MakeWorld(std::uint64_t seed, World& world) {
  const Grid<std::uint8_t> walls = MakeBuilding(kWidth, kHeight, seed);
  world.poses = FreePoses(walls, kScanPlaces, seed);
  ScanInserter inserter;
  for (const Pose2& pose : world.poses) {
    world.scans.push_back(ScanBuilding(walls, pose));
    for (int i = 0; i < kScansPerPlace; ++i) {
      PLUMESCOUT_RETURN_IF_ERROR(inserter.Insert(pose, world.scans.back(), {}, world.grid));
    }
  }
  world.states = Cropped(world.grid.States());
  world.traversable = TraversableCells(world.states, OccupancyOptions{}.inflation_radius_m);
  world.start = world.states.geometry().CellAt(world.poses.front().position());
  return absl::OkStatus();
}

void BenchScans(World& world, BenchSummary& summary) {
  ScanInserter inserter;
  std::size_t next = 0;
  summary.Set("insert_scan_360x8m_ms", MedianCpu_ms(kRepeats, [&] {
                next = (next + 1) % world.poses.size();
                inserter.Insert(world.poses[next], world.scans[next], {}, world.grid).IgnoreError();
              }));
  // Beams of full length: nothing returns.
  Scan open = world.scans.front();
  std::fill(open.ranges_m.begin(), open.ranges_m.end(), std::numeric_limits<float>::infinity());
  const Pose2 middle = {0.05 * kWidth, 0.05 * kHeight, 0.0};
  OccupancyGrid open_grid((OccupancyOptions()));
  summary.Set("insert_open_scan_360x8m_ms", MedianCpu_ms(kRepeats, [&] {
                inserter.Insert(middle, open, {}, open_grid).IgnoreError();
              }));
  BresenhamInserter bresenham;
  summary.Set("bresenham_insert_scan_360x8m_ms", MedianCpu_ms(kRepeats, [&] {
                next = (next + 1) % world.poses.size();
                bresenham.Insert(world.poses[next], world.scans[next], world.grid);
              }));
  summary.Set("bresenham_insert_open_scan_360x8m_ms",
              MedianCpu_ms(kRepeats, [&] { bresenham.Insert(middle, open, open_grid); }));
}

void BenchGrid(const World& world, BenchSummary& summary) {
  const Grid<std::uint8_t> occupied = MaskOf(world.states, CellState::kOccupied);
  summary.Set("distance_field_160x200_ms",
              MedianCpu_ms(kRepeats, [&] { SquaredDistances_cells2(occupied); }));
  summary.Set("all_pairs_distance_field_160x200_ms",
              MedianCpu_ms(kSlowRepeats, [&] { AllPairsDistances_cells2(occupied); }));
  summary.Set("traversable_160x200_ms", MedianCpu_ms(kRepeats, [&] {
                TraversableCells(world.states, OccupancyOptions{}.inflation_radius_m);
              }));
  summary.Set("travel_distances_160x200_ms", MedianCpu_ms(kRepeats, [&] {
                TravelDistances_m(world.traversable, std::vector<Cell>{world.start});
              }));
  summary.Set("heap_travel_distances_160x200_ms",
              MedianCpu_ms(kRepeats, [&] { HeapDistances_m(world.traversable, world.start); }));
}

// A plume around the start, measured along a strip from west to east.
struct Gas {
  explicit Gas(const World& world)
      : mean_ppm(world.states.geometry()), variance_ppm2(world.states.geometry()) {
    constexpr double kPlume_cells = 40.0;
    constexpr double kPeak_ppm = 50.0;
    constexpr int kStrip_cells = 15;
    for (std::size_t i = 0; i < mean_ppm.size(); ++i) {
      const Cell cell = mean_ppm.geometry().CellAtIndex(i);
      const double distance = std::hypot(cell.x - world.start.x, cell.y - world.start.y);
      mean_ppm[i] = static_cast<float>(kPeak_ppm * std::exp(-distance / kPlume_cells));
      variance_ppm2[i] = std::abs(cell.y - world.start.y) < kStrip_cells ? 0.1F : 1.0F;
    }
  }

  Grid<float> mean_ppm;
  Grid<float> variance_ppm2;
};

void BenchFrontiers(const World& world, const Gas& gas, BenchSummary& summary) {
  const FrontierOptions options;
  const std::vector<Cell> starts = {world.start};
  const auto find = [&] {
    return FindOccupancyFrontiers(world.states, world.traversable, starts,
                                  options.min_occupancy_cell_count);
  };
  summary.Set("frontiers_160x200_ms", MedianCpu_ms(kRepeats, find));
  summary.Set("frontiers_found", static_cast<double>(find().size()));

  const GasFrontierInput input = {world.states, world.traversable, gas.mean_ppm, gas.variance_ppm2};
  const auto find_gas = [&] {
    const double observed_ppm2 = ObservedVariance_ppm2(options, GasOptions{});
    return FindGasFrontiers(input, observed_ppm2, GasThreshold_ppm(input, observed_ppm2, options),
                            starts, options);
  };
  summary.Set("gas_frontiers_160x200_ms", MedianCpu_ms(kRepeats, find_gas));
  summary.Set("gas_frontiers_found", static_cast<double>(find_gas().size()));
}

// What is told of each revision beside the rasters, with one robot, and how much of that time is
// for how complete the map is.
void BenchStatus(const World& world, const Gas& gas, BenchSummary& summary) {
  Belief belief;
  belief.options = std::make_shared<const MissionOptions>();
  belief.occupancy = std::make_shared<const Grid<CellState>>(world.states);
  belief.traversable = std::make_shared<const Grid<std::uint8_t>>(world.traversable);
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(gas.mean_ppm);
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(gas.variance_ppm2);
  RobotRecord& robot = belief.robots["r"];
  robot.state.has_pose = true;
  robot.state.pose = world.poses.front();
  robot.first_place = world.poses.front().position();
  const double status_ms = MedianCpu_ms(kRepeats, [&] { MakeMapStatus(belief); });
  const double completeness_ms = MedianCpu_ms(kRepeats, [&] { AssessCompleteness(belief); });
  summary.Set("map_status_160x200_ms", status_ms);
  summary.Set("completeness_160x200_ms", completeness_ms);
  summary.Set("completeness_share_of_map_status", completeness_ms / status_ms);
}

// What a mission of default options takes at most: a map of 31 x 31 tiles that one scan makes, from
// the middle of a tile, by as many beams as may cross so many cells, none of which returns.
constexpr double kFarthest_m = 99.0;
constexpr Pose2 kMiddleOfTile = {3.2, 3.2, 0.0};

Scan LongestScan(const MissionOptions& options) {
  constexpr double kSides = 4.0 / std::numbers::pi;  // cells that a beam crosses by its length
  const double crossings = kSides * kFarthest_m / options.occupancy.resolution_m;
  const auto beams = static_cast<std::size_t>(ScanInserter::kMostCrossings / crossings);
  return {0.0, 2.0 * std::numbers::pi / static_cast<double>(beams), kFarthest_m,
          std::vector<float>(beams, std::numeric_limits<float>::infinity())};
}

// The dearest scan that a mission of default options takes, with all that applying it costs: as the
// first one, for which the map is made, and later.
absl::Status BenchLongestScan(BenchSummary& summary) {
  const MissionOptions options;
  const Scan scan = LongestScan(options);
  std::vector<double> first_ms;
  std::vector<double> later_ms;
  for (int i = 0; i < kSlowRepeats; ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const auto mission, Mission::Create(options));
    PLUMESCOUT_RETURN_IF_ERROR(
        mission->Apply(RobotRegistered{.robot = "r", .radius_m = 0.2, .lease_token = 1}).status());
    for (std::int64_t sequence = 1; sequence <= kSlowRepeats; ++sequence) {
      const EventBody event = ObservationReceived{"r", {sequence, sequence, kMiddleOfTile, scan}};
      const double from_ms = ThreadCpu_ms();
      PLUMESCOUT_ASSIGN_OR_RETURN(const Applied applied, mission->Apply(event));
      (sequence == 1 ? first_ms : later_ms).push_back(ThreadCpu_ms() - from_ms);
      PLUMESCOUT_RETURN_IF_ERROR(applied.observation);
    }
  }
  summary.Set("longest_scan_beams", static_cast<double>(scan.ranges_m.size()));
  summary.Set("longest_scan_ms", Median(later_ms));
  summary.Set("longest_scan_that_makes_the_map_ms", Median(first_ms));
  return absl::OkStatus();
}

absl::Status Run(BenchSummary& summary) {
  PLUMESCOUT_RETURN_IF_ERROR(BenchLongestScan(summary));
  World world;
  PLUMESCOUT_RETURN_IF_ERROR(MakeWorld(summary.seed(), world));
  BenchGrid(world, summary);
  const Gas gas(world);
  BenchFrontiers(world, gas, summary);
  BenchStatus(world, gas, summary);
  BenchScans(world, summary);
  return absl::OkStatus();
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  return plumescout::lab::BenchProgram("What mapping and frontier detection cost")
      .Run(argc, argv, plumescout::lab::Run);
}
