// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/mit_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/gas/gas_map.h"
#include "core/grid/flood.h"
#include "core/occupancy/free_space.h"
#include "core/types/options.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "lab/worlds/synthetic_scene.h"

namespace plumescout::lab {
namespace {

double Plume_ppm(const PlumeSpec& plume, Point2 at) {
  constexpr double kPeak_ppm = 60.0;
  constexpr double kSigma_m = 0.35;  // at the source
  constexpr double kSpread = 0.12;   // by which sigma grows, metres a metre downwind
  const double dx_m = at.x_m - plume.source.x_m;
  const double dy_m = at.y_m - plume.source.y_m;
  const double down_m = dx_m * std::cos(plume.downwind_rad) + dy_m * std::sin(plume.downwind_rad);
  const double across_m = dy_m * std::cos(plume.downwind_rad) - dx_m * std::sin(plume.downwind_rad);
  const double sigma_m = kSigma_m + kSpread * std::max(0.0, down_m);
  const double upwind_m = std::min(0.0, down_m);
  const double off2 = (across_m * across_m + upwind_m * upwind_m) / (sigma_m * sigma_m);
  return kPeak_ppm * kSigma_m / sigma_m * std::exp(-0.5 * off2);
}

Grid<float> TrueGas_ppm(const PlumeSpec& plume, const GridGeometry& geometry) {
  Grid<float> gas_ppm(geometry);
  for (std::size_t i = 0; i < gas_ppm.size(); ++i) {
    gas_ppm[i] = static_cast<float>(Plume_ppm(plume, geometry.Center(geometry.CellAtIndex(i))));
  }
  return gas_ppm;
}

// Walls, and boxes that leave goals, passage and the driven way free.
std::vector<Rectangle> Clutter(const MitSceneSpec& spec) {
  constexpr int kBoxes = 40;
  constexpr double kLeast_m = 0.4;
  constexpr double kMost_m = 1.1;
  constexpr double kClear_m = 0.5;
  std::vector<Point2> keep_free = PointsAlong(spec.driven, kClear_m);
  keep_free.insert(keep_free.end(), spec.goals.begin(), spec.goals.end());
  if (!spec.passage.empty()) {
    const std::vector<Point2> passage = PointsAlong(spec.passage, kClear_m);
    keep_free.insert(keep_free.end(), passage.begin(), passage.end());
  }
  Rng rng(spec.clutter_seed);
  std::vector<Rectangle> boxes = spec.walls;
  for (int i = 0; i < kBoxes; ++i) {
    const Point2 corner{rng.Uniform(0.0, spec.width_m - kMost_m),
                        rng.Uniform(0.0, spec.height_m - kMost_m)};
    const double width_m = rng.Uniform(kLeast_m, kMost_m);
    const double height_m = rng.Uniform(kLeast_m, kMost_m);
    const Rectangle box = Rectangle::Sized(corner, width_m, height_m);
    const bool in_the_way = std::any_of(keep_free.begin(), keep_free.end(), [&](Point2 place) {
      return box.Distance_m(place) < kClear_m;
    });
    if (!in_the_way) boxes.push_back(box);
  }
  return boxes;
}

MitSceneSpec WithPlume(MitSceneSpec spec, std::string name, PlumeSpec plume) {
  spec.name = std::move(name);
  spec.plume = plume;
  return spec;
}
MitSceneSpec WithGoals(MitSceneSpec spec, std::string name, std::array<Point2, 3> goals) {
  spec.name = std::move(name);
  spec.goals = goals;
  return spec;
}
MitSceneSpec WithClutter(MitSceneSpec spec, std::string name, std::uint64_t seed) {
  spec.name = std::move(name);
  spec.clutter_seed = seed;
  return spec;
}

// With I of Eq. (2) between I_min and I_max on n cells: I / sum(I) = (1 - s) I-hat / sum(I-hat) +
// s / n, where s = n I_min / sum(I).
double UniformShareOfUcb(const Grid<std::uint8_t>& reachable, const GasMap& gas,
                         const GasOptions& options, const PlanningOptions& planning) {
  const double unit_ppm2 = planning.raw_variance ? 1.0 : OpenLatticeVariance_ppm2(options);
  double most_ppm = FrontierOptions{}.min_gas_threshold_ppm;
  for (const float mean_ppm : gas.mean_ppm().values()) {
    if (std::isfinite(mean_ppm)) most_ppm = std::max(most_ppm, static_cast<double>(mean_ppm));
  }
  double least = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  double cells = 0.0;
  for (std::size_t i = 0; i < reachable.size(); ++i) {
    if (reachable[i] == 0) continue;
    double variance = gas.variance_ppm2()[i] / unit_ppm2;
    if (!planning.raw_variance) variance = std::min(1.0, variance);
    const double ucb = std::max(0.0F, gas.mean_ppm()[i]) / most_ppm + planning.beta * variance;
    least = std::min(least, ucb);
    sum += ucb;
    cells += 1.0;
  }
  return std::clamp(cells * least / sum, 0.0, 1.0);
}

}  // namespace

absl::StatusOr<MitScene> BuildMitScene(const MitSceneSpec& spec) {
  constexpr double kBetweenReadings_m = 0.6;  // 2 Hz at 1.25 m/s
  MitScene scene;
  scene.name = spec.name;
  scene.occupancy = MakeOccupancy(spec.width_m, spec.height_m, Clutter(spec));
  const GridGeometry& geometry = scene.occupancy.geometry();
  scene.true_gas_ppm = TrueGas_ppm(spec.plume, geometry);
  scene.driven = spec.driven;
  const GasOptions gas_options = PublishedGasOptions();
  GasMap gas(gas_options);
  for (const Point2 at : PointsAlong(spec.driven, kBetweenReadings_m)) {
    gas.Add(0, at, {Plume_ppm(spec.plume, at), 0.0});
  }
  PLUMESCOUT_RETURN_IF_ERROR(gas.Refresh(scene.occupancy, 0));
  const Grid<std::uint8_t> traversable =
      TraversableCells(scene.occupancy, OccupancyOptions{}.inflation_radius_m);
  const Cell start = geometry.CellAt(spec.driven.back());
  scene.start = geometry.Center(start);
  scene.reachable = ReachableCells(traversable, {start});
  PlanningOptions planning;  // beta = lambda of Eq. (2) = 1
  planning.raw_variance = spec.raw_variance;
  scene.information = MakeInformationMap(
      {scene.reachable, gas.mean_ppm(), gas.variance_ppm2(), gas_options, FrontierOptions{}},
      planning);
  scene.ucb_uniform_share = UniformShareOfUcb(scene.reachable, gas, gas_options, planning);
  for (const Point2 place : spec.goals) {
    Goal goal;
    goal.cell = geometry.CellAt(place);
    goal.position = geometry.Center(goal.cell);
    goal.centroid = goal.position;
    if (scene.reachable.At(goal.cell, 0) == 0) {
      return absl::InvalidArgumentError(
          absl::StrCat(spec.name, ": no way to the goal at (", place.x_m, ", ", place.y_m, ")"));
    }
    scene.goals.push_back(goal);
  }
  return scene;
}

MitSceneSpec MitTableScene() {
  MitSceneSpec spec;
  spec.name = "of the table";
  spec.clutter_seed = 1;
  spec.plume = {{4.2, 2.0}, 0.0};
  spec.driven = {{0.8, 8.2}, {2.6, 6.6}, {5.2, 5.4}, {7.0, 2.6},
                 {5.4, 1.6}, {3.4, 2.4}, {1.0, 4.5}};
  spec.goals = {{{6.4, 8.2}, {11.2, 5.2}, {11.2, 1.6}}};
  return spec;
}

MitSceneSpec MitPassageScene() {
  MitSceneSpec spec;
  spec.name = "narrow passage";
  spec.width_m = 20.0;
  spec.height_m = 12.0;
  spec.walls = {{{6.0, 0.0}, {16.0, 2.0}},  {{6.0, 2.8}, {8.8, 5.0}},  {{8.8, 4.0}, {13.2, 5.0}},
                {{13.2, 2.8}, {16.0, 5.0}}, {{9.6, 2.0}, {12.4, 3.2}}, {{10.0, 5.0}, {11.0, 9.5}}};
  spec.passage = {{6.0, 2.4},  {9.2, 2.4},  {9.2, 3.6}, {12.8, 3.6},
                  {12.8, 2.4}, {16.0, 2.4}, {17.5, 2.4}};
  spec.plume = {{5.2, 2.4}, 0.0};
  spec.driven = {{1.0, 10.8}, {5.0, 8.0}, {8.4, 10.6}, {3.0, 6.0}, {7.2, 2.4}, {3.0, 2.4}};
  spec.goals = {{{3.0, 9.2}, {17.5, 10.5}, {17.5, 2.4}}};
  spec.raw_variance = true;
  return spec;
}

std::vector<MitSceneSpec> MitSceneVariants() {
  const MitSceneSpec base = MitTableScene();
  const auto [one, two, three] = base.goals;
  std::vector<MitSceneSpec> variants;
  for (const std::uint64_t seed : {3, 4, 5, 6}) {
    variants.push_back(WithClutter(base, absl::StrCat("boxes ", seed), seed));
  }
  variants.push_back(WithPlume(base, "source 1 m east", {{5.2, 2.0}, 0.0}));
  variants.push_back(WithPlume(base, "source 1 m west", {{3.2, 2.0}, 0.0}));
  variants.push_back(WithPlume(base, "source 1 m north", {{4.2, 3.0}, 0.0}));
  variants.push_back(WithPlume(base, "wind to north-east", {{4.2, 2.0}, 0.4}));
  variants.push_back(WithGoals(base, "goal 1 2 m east", {{{8.4, 8.2}, two, three}}));
  variants.push_back(WithGoals(base, "goal 2 2 m west", {{one, {9.2, 5.2}, three}}));
  variants.push_back(WithGoals(base, "goal 2 1 m north", {{one, {11.2, 6.2}, three}}));
  variants.push_back(WithGoals(base, "goal 3 2 m west", {{one, two, {9.2, 1.6}}}));
  variants.push_back(WithGoals(base, "goal 2 near", {{one, {8.2, 5.2}, three}}));
  variants.push_back(base);
  variants.back().name = "variance as printed";
  variants.back().raw_variance = true;
  return variants;
}

}  // namespace plumescout::lab
