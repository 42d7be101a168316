// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/quarter_plan.h"

#include <algorithm>

#include "core/types/rng.h"
#include "lab/worlds/fill.h"

namespace plumescout::lab {
namespace {

constexpr int kWidth = 68;
constexpr int kHeight = 74;
constexpr double kResolution_m = 13.0;
constexpr double kHalfWidth_m = 21.0 * kResolution_m;   // of the built-up area: some 550 m
constexpr double kHalfHeight_m = 24.0 * kResolution_m;  // and some 620 m, as central in the raster

// From `least` to `most`, both included.
int Draw(int least, int most, Rng& rng) {
  return least + static_cast<int>(rng.Below(static_cast<std::uint64_t>(most - least + 1)));
}

bool Chance(double probability, Rng& rng) { return rng.Uniform01() < probability; }

// A yard that is open to one of the block's corners.
void CutYard(const CellRect& block, Rng& rng, Grid<CellState>& occupancy) {
  const int width = Draw(1, block.width() / 2, rng);
  const int height = Draw(1, block.height() / 2, rng);
  const int west = Chance(0.5, rng) ? block.min.x : block.end.x - width;
  const int south = Chance(0.5, rng) ? block.min.y : block.end.y - height;
  Fill(CellRect::Sized({west, south}, width, height), CellState::kFree, occupancy);
}

void Build(const CellRect& block, const BuiltUpArea& area, Rng& rng, Grid<CellState>& occupancy) {
  constexpr double kSquares = 0.08;  // of the blocks
  constexpr double kYards = 0.4;
  const Point2 low = occupancy.geometry().Center(block.min);
  const Point2 high = occupancy.geometry().Center({block.end.x - 1, block.end.y - 1});
  const Point2 middle{(low.x_m + high.x_m) / 2.0, (low.y_m + high.y_m) / 2.0};
  const bool is_square = Chance(kSquares, rng);
  const bool has_yard = Chance(kYards, rng);
  if (!area.Holds(middle) || is_square) return;
  Fill(block, CellState::kOccupied, occupancy);
  if (has_yard) CutYard(block, rng, occupancy);
}

// One row of blocks, from edge to edge of the built-up area's frame.
void BuildRow(int south, int north, const BuiltUpArea& area, Rng& rng, Grid<CellState>& occupancy) {
  const GridGeometry& geometry = occupancy.geometry();
  const int last = geometry.CellAt({area.center.x_m + area.half_width_m, 0.0}).x;
  int west = geometry.CellAt({area.center.x_m - area.half_width_m, 0.0}).x + Draw(0, 2, rng);
  while (west < last) {
    const int east = west + Draw(3, 7, rng);
    Build({{west, south}, {east, north}}, area, rng, occupancy);
    west = east + Draw(1, 2, rng);
  }
}

}  // namespace

bool BuiltUpArea::Holds(Point2 point) const {
  const double x = (point.x_m - center.x_m) / half_width_m;
  const double y = (point.y_m - center.y_m) / half_height_m;
  return x * x + y * y <= 1.0;
}

QuarterPlan MakeQuarterPlan(std::uint64_t seed) {
  constexpr int kRoadWidth = 3;
  const GridGeometry geometry{0.0, 0.0, kResolution_m, kWidth, kHeight};
  QuarterPlan plan;
  plan.occupancy = Grid<CellState>(geometry, CellState::kFree);
  plan.built_up = {
      {kWidth * kResolution_m / 2.0, kHeight * kResolution_m / 2.0}, kHalfWidth_m, kHalfHeight_m};
  Rng rng(seed);
  const int first = geometry.CellAt({0.0, plan.built_up.center.y_m - kHalfHeight_m}).y;
  const int last = geometry.CellAt({0.0, plan.built_up.center.y_m + kHalfHeight_m}).y;
  bool road_built = false;
  for (int south = first; south < last;) {
    const int north = south + Draw(2, 4, rng);
    BuildRow(south, north, plan.built_up, rng, plan.occupancy);
    const bool is_road = !road_built && north >= kHeight / 2;
    road_built |= is_road;
    south = north + (is_road ? kRoadWidth : 2);
  }
  return plan;
}

}  // namespace plumescout::lab
