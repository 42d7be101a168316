// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/plan/cost/information_map.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "lab/worlds/synthetic_scene.h"

namespace plumescout::lab {

// A plume in even wind: Gaussian across the wind, wider and thinner the farther downwind. Walls do
// not hold it up.
struct PlumeSpec {
  Point2 source;
  double downwind_rad;  // direction that the wind blows to, frame map
};

// One situation of [MIT] Fig. 1: boxes, a plume, and a robot that has driven `driven`, reading gas
// all the way, and now stands at its end with three frontiers to choose from.
struct MitSceneSpec {
  std::string name;
  double width_m = 12.0;
  double height_m = 9.0;
  std::vector<Rectangle> walls{};
  std::vector<Point2> passage{};   // kept free of boxes, like the way that was driven
  std::uint64_t clutter_seed = 1;  // of the boxes
  PlumeSpec plume;
  std::vector<Point2> driven;
  std::array<Point2, 3> goals;
  bool raw_variance = false;  // Eq. (2) as printed, with the variance in ppm^2
};

struct MitScene {
  std::string name;
  Grid<CellState> occupancy;
  Grid<float> true_gas_ppm;
  InformationMap information;  // of the posterior after the drive: UCB, Eq. (2), as I-hat
  // Draws from Eq. (2) itself, which is nowhere 0, are draws from I-hat with this share of even
  // ones.
  double ucb_uniform_share = 0.0;
  Grid<std::uint8_t> reachable;  // from the start
  Point2 start;
  std::vector<Goal> goals;
  std::vector<Point2> driven;
};

// kInvalidArgument, naming scene and goal, if there is no way to a goal.
absl::StatusOr<MitScene> BuildMitScene(const MitSceneSpec& spec);

// The scene of the table.
MitSceneSpec MitTableScene();
// Another, chosen before any planner was run in it: larger, Eq. (2) as printed, and the way to the
// third frontier that has gas is a bent passage 0.8 m wide, somewhat shorter than the way round
// through the open, which has none. So few even samples fall into it that a search finds it by
// luck.
MitSceneSpec MitPassageScene();
// That of the table with one thing changed: boxes, plume, goals, or how the variance is weighed.
std::vector<MitSceneSpec> MitSceneVariants();

}  // namespace plumescout::lab
