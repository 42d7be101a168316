// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/concentration_slice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace plumescout::lab {
namespace {

constexpr double kCutOff_sigma = 3.0;

constexpr int kMaxRow = 2 * LineOfSight::kMaxRadius_cells + 1;

// A filament in units of cells, against the centre of the cell that holds it.
struct CellGaussian {
  double east = 0.0;
  double north = 0.0;
  double exponent = 0.0;  // -1 / (2 sigma^2)
  double cut_off = 0.0;
  int reach = 0;  // no cell farther than this, per axis, is within the cut-off

  double Along(double offset) const { return std::exp(exponent * offset * offset); }
};

CellGaussian GaussianOf(Point2 position, double sigma_m, const GridGeometry& geometry, int radius) {
  const Point2 middle = geometry.Center(geometry.CellAt(position));
  const double sigma = sigma_m / geometry.resolution_m;
  CellGaussian g;
  g.east = (position.x_m - middle.x_m) / geometry.resolution_m;
  g.north = (position.y_m - middle.y_m) / geometry.resolution_m;
  g.exponent = -0.5 / (sigma * sigma);
  g.cut_off = std::min<double>(kCutOff_sigma * sigma, radius);
  g.reach = std::min(radius, static_cast<int>(g.cut_off + 0.5));
  return g;
}

// Adds row_peak * gaussian to the cells [first, last] around `middle` that `seen` has bits for.
void AddRow(std::uint64_t seen, int first, int last, const float* gaussian, float row_peak,
            float* middle) {
  const std::uint64_t all = (std::uint64_t{1} << (last - first + 1)) - 1;  // at most 63 cells
  if ((seen & all) == all) {
    for (int dx = first; dx <= last; ++dx) middle[dx] += row_peak * gaussian[dx];
    return;
  }
  for (int dx = first; dx <= last; ++dx, seen >>= 1) {
    if ((seen & 1) != 0) middle[dx] += row_peak * gaussian[dx];
  }
}

}  // namespace

SliceRenderer::SliceRenderer(const Grid<CellState>& occupancy,
                             const std::vector<GasSource>& sources, const GasParameters& gas)
    : occupancy_(occupancy),
      sources_(sources),
      gas_(gas),
      sight_(occupancy, LineOfSight::kMaxRadius_cells) {}

std::vector<Grid<float>> SliceRenderer::Render(const std::vector<Filament>& filaments) {
  std::vector<Grid<float>> layers(sources_.size(), Grid<float>(occupancy_.geometry()));
  for (const Filament& filament : filaments) {
    Add(filament, layers[static_cast<std::size_t>(filament.source)]);
  }
  return layers;
}

const FilamentShape& SliceRenderer::UnitShape(int age_steps) {
  GasSource unit;
  unit.rate_ppm_per_s = 1.0;
  for (auto age = static_cast<int>(shapes_.size()); age <= age_steps; ++age) {
    shapes_.push_back(ShapeAtAge(unit, gas_, age * Plume::kStep_s));
  }
  return shapes_[static_cast<std::size_t>(age_steps)];
}

void SliceRenderer::Add(const Filament& filament, Grid<float>& layer) {
  const GridGeometry& geometry = layer.geometry();
  const Cell cell = geometry.CellAt(filament.position);
  if (occupancy_.At(cell, CellState::kOccupied) != CellState::kFree) return;
  const FilamentShape& shape = UnitShape(filament.age_steps);
  const GasSource& source = sources_[static_cast<std::size_t>(filament.source)];
  const double peak_ppm = shape.peak_ppm * source.rate_ppm_per_s;
  const int radius = sight_.radius_cells();
  const CellGaussian g = GaussianOf(filament.position, shape.sigma_m, geometry, radius);
  std::array<float, kMaxRow> buffer;
  float* gaussian = &buffer[static_cast<std::size_t>(radius)];
  for (int dx = -g.reach; dx <= g.reach; ++dx) {
    gaussian[dx] = static_cast<float>(g.Along(dx - g.east));
  }
  const std::span<const std::uint64_t> seen = sight_.From(cell);
  for (int dy = -g.reach; dy <= g.reach; ++dy) {
    const double off = dy - g.north;
    const double width2 = g.cut_off * g.cut_off - off * off;
    if (width2 < 0.0) continue;
    const int first = std::max(-g.reach, static_cast<int>(std::ceil(g.east - std::sqrt(width2))));
    const int last = std::min(g.reach, static_cast<int>(std::floor(g.east + std::sqrt(width2))));
    const std::uint64_t row = seen[static_cast<std::size_t>(dy + radius)] >> (first + radius);
    if (row == 0) continue;  // as are all rows beyond the raster
    float* middle = layer.values().data() +
                    (static_cast<std::ptrdiff_t>(cell.y + dy) * geometry.width + cell.x);
    const auto row_peak = static_cast<float>(peak_ppm * g.Along(off));
    AddRow(row, first, last, gaussian, row_peak, middle);
  }
}

}  // namespace plumescout::lab
