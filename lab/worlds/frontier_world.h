// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/map_snapshot.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"

namespace plumescout::lab {

// A small building that gas has spread through, for pictures in which cells can be told apart.
struct FrontierWorld {
  Grid<CellState> occupancy;
  Grid<float> gas_ppm;  // 0 where occupied
  Point2 source;
  std::vector<Point2> entry;  // how the robot comes in, before its first plan
};

// Cells of 0.25 m: corridors three cells wide that meet in the south. The gas is the steady state
// of diffusion from a leak in the room at the end of the eastern one to vents at the end of the
// northern one and at the entry in the south-west, so walls hold it up.
FrontierWorld MakeFrontierWorld();

// The mission's belief after one reading.
struct FrontierReading {
  int step = 0;  // plans issued before
  Point2 position;
  double driven_m = 0.0;
  double reading_ppm = 0.0;
  double threshold_ppm = 0.0;  // tau_gas, [XIT] Eq. (17)
  int observed_cells = 0;
  int critical_cells = 0;  // Eq. (19)
  int frontiers = 0;       // gas frontiers that are not too small
  int frontier_cells = 0;  // of those
};

// One planning step: what the robot knew and where it chose to go.
struct FrontierStep {
  std::shared_ptr<const Belief> belief;
  MapSnapshot map;
  Pose2 robot;
  Plan plan;
  std::vector<Point2> driven;  // so far
};

struct FrontierWalk {
  std::vector<FrontierStep> steps;
  std::vector<FrontierReading> readings;
};

// Lets a robot walk in and then follow three plans of XIT-GFF, with a scan and a gas reading at
// every cell's length, under either scope of WGFD. Errors: those of the mission and the planner.
absl::StatusOr<FrontierWalk> WalkFrontiers(const FrontierWorld& world, WgfdScope scope,
                                           std::uint64_t seed);

// Gas frontiers of a map that are goals.
std::vector<const Frontier*> GasFrontiers(const MapSnapshot& map);

// What the figure shows of a cell.
enum class GasMark { kWall, kUnknown, kUnobserved, kObserved, kCritical };
Grid<GasMark> ClassifyGas(const FrontierStep& step);

}  // namespace plumescout::lab
