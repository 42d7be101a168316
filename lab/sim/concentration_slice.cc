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

// Rows are added in blocks of cells, masked: no branches, and the compiler makes them vectors.
constexpr int kBlock = 8;
constexpr int kMaxRow = 2 * LineOfSight::kMaxRadius_cells + 1 + kBlock;
// In front of and behind a layer, for the blocks that reach beyond its first and last row.
constexpr std::size_t kPadding = kMaxRow;

using BlockMask = std::array<float, kBlock>;

// By the bits of a byte: 1 where the bit is set, else 0.
constexpr std::array<BlockMask, 1 << kBlock> MakeMasks() {
  std::array<BlockMask, 1 << kBlock> masks{};
  for (std::size_t bits = 0; bits < masks.size(); ++bits) {
    for (std::size_t k = 0; k < kBlock; ++k) masks[bits][k] = (bits >> k & 1) != 0 ? 1.0F : 0.0F;
  }
  return masks;
}
constexpr std::array<BlockMask, 1 << kBlock> kMasks = MakeMasks();

// bell[k] = exp(exponent * (k - offset)^2) for |k| <= reach, with edge = exp(exponent). Neighbours
// have a ratio that shrinks by edge^2 from each to the next: two multiplications a value.
void FillBell(double exponent, double edge, double offset, int reach, float* bell) {
  const double middle = std::exp(exponent * offset * offset);
  bell[0] = static_cast<float>(middle);
  if (reach == 0) return;
  const double lean = std::exp(-2.0 * exponent * offset);
  double up = middle;
  double down = middle;
  double up_ratio = edge * lean;
  double down_ratio = edge / lean;
  for (int k = 1; k <= reach; ++k) {
    bell[k] = static_cast<float>(up *= up_ratio);
    bell[-k] = static_cast<float>(down *= down_ratio);
    up_ratio *= edge * edge;
    down_ratio *= edge * edge;
  }
}

// std::ceil for small numbers, which without SSE4 is a call.
int RoundUp(double value) {
  const int whole = static_cast<int>(value);
  return whole + (value > whole ? 1 : 0);
}

// Adds row_peak * bell to the cells from `row` on that `seen` has bits for.
void AddRow(std::uint64_t seen, const float* bell, float row_peak, float* row) {
  for (; seen != 0; seen >>= kBlock, bell += kBlock, row += kBlock) {
    const BlockMask& mask = kMasks[seen & (kMasks.size() - 1)];
    BlockMask sum;
    for (std::size_t k = 0; k < kBlock; ++k) sum[k] = row[k] + row_peak * bell[k] * mask[k];
    std::copy(sum.begin(), sum.end(), row);
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
  padded_.assign(sources_.size(), std::vector<float>(occupancy_.size() + 2 * kPadding));
  for (const Filament& filament : filaments) {
    Add(filament, &padded_[static_cast<std::size_t>(filament.source)][kPadding]);
  }
  std::vector<Grid<float>> layers(sources_.size(), Grid<float>(occupancy_.geometry()));
  for (std::size_t s = 0; s < layers.size(); ++s) {
    std::copy_n(&padded_[s][kPadding], layers[s].size(), layers[s].values().begin());
  }
  return layers;
}

const SliceRenderer::AgeShape& SliceRenderer::ShapeOf(int age_steps) {
  GasSource unit;
  unit.rate_ppm_per_s = 1.0;
  const double resolution_m = occupancy_.geometry().resolution_m;
  for (auto age = static_cast<int>(shapes_.size()); age <= age_steps; ++age) {
    const FilamentShape filament = ShapeAtAge(unit, gas_, age * Plume::kStep_s);
    const double sigma = filament.sigma_m / resolution_m;
    AgeShape shape;
    shape.peak_ppm = filament.peak_ppm;
    shape.exponent = -0.5 / (sigma * sigma);
    shape.edge = std::exp(shape.exponent);
    shape.cut_off = std::min<double>(kCutOff_sigma * sigma, sight_.radius_cells());
    shape.reach = std::min(sight_.radius_cells(), static_cast<int>(shape.cut_off + 0.5));
    shapes_.push_back(shape);
  }
  return shapes_[static_cast<std::size_t>(age_steps)];
}

void SliceRenderer::Add(const Filament& filament, float* layer) {
  const GridGeometry& geometry = occupancy_.geometry();
  const Cell cell = geometry.CellAt(filament.position);
  if (occupancy_.At(cell, CellState::kOccupied) != CellState::kFree) return;
  const AgeShape& shape = ShapeOf(filament.age_steps);
  const Point2 middle = geometry.Center(cell);
  const double east = (filament.position.x_m - middle.x_m) / geometry.resolution_m;
  const double north = (filament.position.y_m - middle.y_m) / geometry.resolution_m;
  const int reach = shape.reach;
  std::array<float, kMaxRow> along_row;  // [k + reach] for the cell k to the east
  std::array<float, kMaxRow> across_rows;
  std::fill(&along_row[static_cast<std::size_t>(2 * reach + 1)], along_row.end(), 0.0F);
  FillBell(shape.exponent, shape.edge, east, reach, &along_row[static_cast<std::size_t>(reach)]);
  FillBell(shape.exponent, shape.edge, north, reach, &across_rows[static_cast<std::size_t>(reach)]);
  const double rate_ppm_per_s = sources_[static_cast<std::size_t>(filament.source)].rate_ppm_per_s;
  const auto peak_ppm = static_cast<float>(shape.peak_ppm * rate_ppm_per_s);
  const int radius = sight_.radius_cells();
  const std::span<const std::uint64_t> seen = sight_.From(cell);
  for (int dy = -reach; dy <= reach; ++dy) {
    const double off = dy - north;
    const double width2 = shape.cut_off * shape.cut_off - off * off;
    if (width2 < 0.0) continue;
    const double width = std::sqrt(width2);
    const int first = std::max(-reach, RoundUp(east - width));
    const int last = std::min(reach, -RoundUp(-(east + width)));
    const std::uint64_t within = (std::uint64_t{1} << (last - first + 1)) - 1;  // up to 63 cells
    const std::uint64_t row =
        seen[static_cast<std::size_t>(dy + radius)] >> (first + radius) & within;
    if (row == 0) continue;  // as are all rows beyond the raster
    float* cells = layer + static_cast<std::ptrdiff_t>(cell.y + dy) * geometry.width + cell.x;
    AddRow(row, &along_row[static_cast<std::size_t>(first + reach)],
           peak_ppm * across_rows[static_cast<std::size_t>(dy + reach)], cells + first);
  }
}

}  // namespace plumescout::lab
