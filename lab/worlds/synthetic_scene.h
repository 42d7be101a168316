// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/plan/cost/information_map.h"
#include "core/plan/paths/path_planner.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "core/types/rectangle.h"
#include "lab/report/map_panel.h"

namespace plumescout::lab {

// A Gaussian cloud of gas; walls do not hold it up.
struct GasCloud {
  Point2 center;
  double peak_ppm;
  double sigma_m;
};

struct SceneSpec {
  std::string name;
  double width_m = 12.0;
  double height_m = 9.0;
  std::vector<Rectangle> obstacles;
  std::vector<GasCloud> clouds;
  Point2 start;
  Point2 goal;
};

// Where one search from one start to one goal is studied: everything known, in cells of 0.1 m with
// an outer wall, the gas with one variance everywhere, so that the information map is the mean.
struct SyntheticScene {
  std::string name;
  Grid<CellState> occupancy;
  InformationMap information;
  Grid<std::uint8_t> reachable;  // from the start, with the default inflation
  Point2 start;                  // a cell's centre
  Goal goal;
};

// Cells of 0.1 m: free, but for an outer wall and the obstacles.
Grid<CellState> MakeOccupancy(double width_m, double height_m,
                              const std::vector<Rectangle>& obstacles);

SyntheticScene BuildScene(const SceneSpec& spec);

// Gas away from the straight way, between obstacles: what the distance weight is to show on.
SceneSpec DistanceWeightScene();
// Columns, rooms and random clutter, with two or three clouds each.
std::vector<SceneSpec> ConvergenceScenes();

// Mean of I-hat along a path.
double MeanInformation(const SyntheticScene& scene, const std::vector<Point2>& path);
double PathLength_m(const std::vector<Point2>& path);
// Points on a path, at most a step apart, its vertices among them. REQUIRES: step_m > 0.
std::vector<Point2> PointsAlong(const std::vector<Point2>& path, double step_m);

// The field with start and goal; the paths are left to the caller.
MapPanel MakeScenePanel(const SyntheticScene& scene);
// A path on such a panel, with a rim that sets it off.
void AddPath(const std::vector<Point2>& path, const Stroke& stroke, MapPanel& panel);

}  // namespace plumescout::lab
