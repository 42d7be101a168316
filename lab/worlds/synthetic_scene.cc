// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/synthetic_scene.h"

#include <algorithm>
#include <cmath>

#include "core/grid/flood.h"
#include "core/occupancy/free_space.h"
#include "core/plan/cost/edge_cost.h"
#include "core/types/options.h"
#include "core/types/rng.h"
#include "lab/report/palette.h"

namespace plumescout::lab {
namespace {

constexpr double kResolution_m = 0.1;
constexpr double kWall_m = 0.1;

void Build(const Rectangle& solid, Grid<CellState>& occupancy) {
  for (std::size_t i = 0; i < occupancy.size(); ++i) {
    const Point2 at = occupancy.geometry().Center(occupancy.geometry().CellAtIndex(i));
    if (solid.Surrounds(at)) occupancy[i] = CellState::kOccupied;
  }
}

Grid<float> MakeMean_ppm(const SceneSpec& spec, const GridGeometry& geometry) {
  Grid<float> mean_ppm(geometry, 0.0F);
  for (std::size_t i = 0; i < mean_ppm.size(); ++i) {
    const Point2 at = geometry.Center(geometry.CellAtIndex(i));
    double sum_ppm = 0.0;
    for (const GasCloud& cloud : spec.clouds) {
      const double in_sigmas = Distance_m(at, cloud.center) / cloud.sigma_m;
      sum_ppm += cloud.peak_ppm * std::exp(-0.5 * in_sigmas * in_sigmas);
    }
    mean_ppm[i] = static_cast<float>(sum_ppm);
  }
  return mean_ppm;
}

SceneSpec ColumnsScene() {
  SceneSpec spec;
  spec.name = "Columns";
  constexpr double kSide_m = 0.8;
  constexpr double kSpacing_m = 2.0;
  constexpr int kColumns = 5;
  constexpr int kRows = 4;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double shift_m = row % 2 == 0 ? 0.0 : 0.5 * kSpacing_m;
      const Point2 corner{1.2 + column * kSpacing_m + shift_m, 0.9 + row * kSpacing_m};
      spec.obstacles.push_back(Rectangle::Sized(corner, kSide_m, kSide_m));
    }
  }
  spec.clouds = {{{3.5, 6.8}, 40.0, 1.5}, {{8.5, 3.0}, 60.0, 1.3}};
  spec.start = {0.6, 0.6};
  spec.goal = {11.3, 8.3};
  return spec;
}

SceneSpec RoomsScene() {
  SceneSpec spec;
  spec.name = "Rooms";
  spec.obstacles = {{{3.8, 0.0}, {4.0, 1.2}},  {{3.8, 2.4}, {4.0, 6.4}}, {{3.8, 7.6}, {4.0, 9.0}},
                    {{7.8, 0.0}, {8.0, 3.4}},  {{7.8, 4.6}, {8.0, 9.0}}, {{4.8, 3.6}, {6.2, 4.4}},
                    {{9.2, 5.4}, {10.8, 5.6}}, {{1.6, 5.0}, {2.4, 6.6}}, {{9.4, 1.4}, {10.2, 2.2}}};
  spec.clouds = {{{5.8, 6.6}, 50.0, 1.2}, {{10.0, 3.6}, 30.0, 1.4}, {{2.0, 7.6}, 20.0, 1.0}};
  spec.start = {0.8, 0.8};
  spec.goal = {11.0, 7.8};
  return spec;
}

SceneSpec ClutterScene() {
  SceneSpec spec;
  spec.name = "Clutter";
  spec.start = {0.6, 4.5};
  spec.goal = {11.4, 4.5};
  constexpr std::uint64_t kSeed = 5;  // of the boxes, whatever the seed of the experiment
  constexpr int kBoxes = 34;
  constexpr double kClear_m = 1.2;  // around start and goal
  Rng rng(kSeed);
  for (int i = 0; i < kBoxes; ++i) {
    const Point2 corner{rng.Uniform(0.8, 10.4), rng.Uniform(0.0, 8.4)};
    const double width_m = rng.Uniform(0.3, 1.1);
    const double height_m = rng.Uniform(0.3, 1.1);
    const Point2 middle{corner.x_m + 0.5 * width_m, corner.y_m + 0.5 * height_m};
    if (Distance_m(middle, spec.start) < kClear_m || Distance_m(middle, spec.goal) < kClear_m) {
      continue;
    }
    spec.obstacles.push_back(Rectangle::Sized(corner, width_m, height_m));
  }
  spec.clouds = {{{3.6, 1.8}, 40.0, 1.3}, {{6.6, 7.2}, 60.0, 1.2}, {{9.0, 2.6}, 30.0, 1.2}};
  return spec;
}

}  // namespace

Grid<CellState> MakeOccupancy(double width_m, double height_m,
                              const std::vector<Rectangle>& obstacles) {
  Grid<CellState> occupancy(
      GridGeometry{0.0, 0.0, kResolution_m, static_cast<int>(std::lround(width_m / kResolution_m)),
                   static_cast<int>(std::lround(height_m / kResolution_m))},
      CellState::kFree);
  Build(Rectangle::Sized({0.0, 0.0}, width_m, kWall_m), occupancy);
  Build(Rectangle::Sized({0.0, height_m - kWall_m}, width_m, kWall_m), occupancy);
  Build(Rectangle::Sized({0.0, 0.0}, kWall_m, height_m), occupancy);
  Build(Rectangle::Sized({width_m - kWall_m, 0.0}, kWall_m, height_m), occupancy);
  for (const Rectangle& obstacle : obstacles) Build(obstacle, occupancy);
  return occupancy;
}

SyntheticScene BuildScene(const SceneSpec& spec) {
  SyntheticScene scene;
  scene.name = spec.name;
  scene.occupancy = MakeOccupancy(spec.width_m, spec.height_m, spec.obstacles);
  const GridGeometry& geometry = scene.occupancy.geometry();
  const Grid<std::uint8_t> traversable =
      TraversableCells(scene.occupancy, OccupancyOptions{}.inflation_radius_m);
  const GasOptions gas = PublishedGasOptions();
  const Grid<float> variance_ppm2(geometry, static_cast<float>(OpenLatticeVariance_ppm2(gas)));
  scene.information = MakeInformationMap(
      {traversable, MakeMean_ppm(spec, geometry), variance_ppm2, gas, FrontierOptions{}},
      PlanningOptions{});
  const Cell start = geometry.CellAt(spec.start);
  scene.start = geometry.Center(start);
  scene.reachable = ReachableCells(traversable, {start});
  scene.goal.cell = geometry.CellAt(spec.goal);
  scene.goal.position = geometry.Center(scene.goal.cell);
  scene.goal.centroid = scene.goal.position;
  return scene;
}

SceneSpec DistanceWeightScene() {
  SceneSpec spec;
  spec.name = "Two ways round";
  spec.obstacles = {{{2.6, 3.2}, {3.4, 4.8}}, {{5.2, 3.8}, {6.8, 4.6}}, {{8.4, 3.2}, {9.2, 4.8}},
                    {{3.8, 6.2}, {4.6, 7.0}}, {{7.4, 6.2}, {8.2, 7.0}}, {{5.6, 1.2}, {6.4, 2.0}}};
  spec.clouds = {{{2.2, 5.8}, 40.0, 1.0},
                 {{4.2, 7.4}, 40.0, 1.0},
                 {{6.2, 7.6}, 40.0, 1.0},
                 {{8.2, 7.2}, 40.0, 1.0},
                 {{10.0, 5.6}, 40.0, 1.0}};
  spec.start = {0.8, 4.0};
  spec.goal = {11.2, 4.0};
  return spec;
}

std::vector<SceneSpec> ConvergenceScenes() {
  return {ColumnsScene(), RoomsScene(), ClutterScene()};
}

std::vector<Point2> PointsAlong(const std::vector<Point2>& way, double step_m) {
  std::vector<Point2> points = {way.front()};
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double length_m = Distance_m(way[i - 1], way[i]);
    const int steps = std::max(1, static_cast<int>(std::ceil(length_m / step_m)));
    for (int k = 1; k <= steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      points.push_back({way[i - 1].x_m + share * (way[i].x_m - way[i - 1].x_m),
                        way[i - 1].y_m + share * (way[i].y_m - way[i - 1].y_m)});
    }
  }
  return points;
}

double PathLength_m(const std::vector<Point2>& path) {
  double length_m = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) length_m += Distance_m(path[i], path[i + 1]);
  return length_m;
}

double MeanInformation(const SyntheticScene& scene, const std::vector<Point2>& path) {
  double integral_cells = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    integral_cells += SegmentIntegral_cells(scene.information.value, path[i], path[i + 1]);
  }
  return integral_cells * scene.occupancy.geometry().resolution_m / PathLength_m(path);
}

MapPanel MakeScenePanel(const SyntheticScene& scene) {
  constexpr Rgb kStartMark{22, 150, 84};
  constexpr Rgb kGoalMark{226, 54, 54};
  const ColorScale scale{ColorMap::kGas, 0.0, 1.0, false};
  MapPanel panel;
  panel.title = scene.name;
  panel.region = RegionOf(scene.occupancy.geometry());
  panel.cells = PaintCells(scene.occupancy.geometry(), panel.region, [&](Cell cell) {
    if (scene.occupancy[cell] != CellState::kFree) return kWallColor;
    return std::isfinite(scene.information.penalty[cell]) ? scale(scene.information.value[cell])
                                                          : kUnknownColor;
  });
  panel.marks = {{MarkShape::kDisc, kStartMark, scene.start},
                 {MarkShape::kDisc, kGoalMark, scene.goal.position}};
  panel.color_bar = ColorBar{scale, "UCB"};
  panel.legend = {{"start", MarkShape::kDisc, kStartMark}, {"goal", MarkShape::kDisc, kGoalMark}};
  return panel;
}

void AddPath(const std::vector<Point2>& path, const Stroke& stroke, MapPanel& panel) {
  constexpr double kRim_px = 2.5;
  panel.lines.push_back({path, {kPaper, stroke.width_px + kRim_px}});
  panel.lines.push_back({path, stroke});
}

}  // namespace plumescout::lab
