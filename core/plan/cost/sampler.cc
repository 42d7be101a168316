// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/sampler.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/grid/mask.h"
#include "core/grid/padded.h"
#include "core/plan/cost/hilbert.h"
#include "core/types/cell_rect.h"

namespace plumescout {
namespace {

// Successive draws without replacement, by exponential keys (Efraimidis and Spirakis 2006): the
// `count` least of Exp(1) / q have the law of drawing one after the other.
std::vector<Cell> DrawIid(const Grid<float>& mass, std::size_t count, Rng& rng,
                          const StopFn& stop) {
  std::vector<std::pair<double, std::size_t>> keys;
  const bool is_whole = InPieces(mass.size(), stop, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      if (mass[i] > 0.0F) keys.emplace_back(-std::log1p(-rng.Uniform01()) / mass[i], i);
    }
  });
  if (!is_whole) return {};
  count = std::min(count, keys.size());
  std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(count), keys.end());
  keys.resize(count);
  std::sort(keys.begin(), keys.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
  std::vector<Cell> samples;
  samples.reserve(count);
  for (const auto& [key, index] : keys) samples.push_back(mass.geometry().CellAtIndex(index));
  return samples;
}

// Where there is mass.
struct MassCells {
  CellRect bounds;
  std::size_t count = 0;
  double sum = 0.0;  // row by row
};

MassCells FindMass(const Grid<float>& mass, const StopFn& stop) {
  const auto has_mass = [](float q) { return q > 0.0F; };
  MassCells cells;
  ByRows(0, mass.height(), mass.width(), stop, [&](int y) {
    const float* const row = GridRow(mass, y);
    const float* const end = row + mass.width();
    const float* const first = std::find_if(row, end, has_mass);
    if (first == end) return;
    const float* last = end - 1;
    while (!has_mass(*last)) --last;
    std::size_t count = 0;
    double sum = cells.sum;
    for (const float* q = first; q <= last; ++q) {
      count += has_mass(*q) ? 1 : 0;
      sum += static_cast<double>(*q);
    }
    cells.count += count;
    cells.sum = sum;
    cells.bounds.Include({static_cast<int>(first - row), y});
    cells.bounds.Include({static_cast<int>(last - row), y});
  });
  return cells;
}

// Distance in mass between systematic draws. Cells with at least that much are drawn for certain
// and the others share the draws that remain, so that no cell is met twice.
// REQUIRES: more than `count` cells with mass.
double SystematicStep(const Grid<float>& mass, const MassCells& cells, std::size_t count,
                      const StopFn& stop) {
  const CellRect& bounds = cells.bounds;
  double step = cells.sum / static_cast<double>(count);
  std::size_t certain = 0;
  // Ends: the step shrinks and more cells become certain in every round but the last.
  while (true) {
    std::size_t now_certain = 0;
    bool is_whole = ByRows(bounds.min.y, bounds.end.y, bounds.width(), stop, [&](int y) {
      const float* const row = GridRow(mass, y);
      int in_row = 0;
      for (int x = bounds.min.x; x < bounds.end.x; ++x) in_row += row[x] >= step ? 1 : 0;
      now_certain += static_cast<std::size_t>(in_row);
    });
    if (now_certain == certain || now_certain >= count || !is_whole) return step;
    certain = now_certain;
    double shared_mass = 0.0;
    is_whole = ByRows(bounds.min.y, bounds.end.y, bounds.width(), stop, [&](int y) {
      const float* const row = GridRow(mass, y);
      for (int x = bounds.min.x; x < bounds.end.x; ++x) {
        shared_mass += row[x] >= step ? 0.0 : static_cast<double>(row[x]);
      }
    });
    if (!is_whole) return step;
    step = shared_mass / static_cast<double>(count - certain);
  }
}

std::vector<Cell> DrawSystematic(const Grid<float>& mass, std::size_t count, Rng& rng,
                                 const StopFn& stop) {
  const MassCells cells = FindMass(mass, stop);
  const double step = count < cells.count ? SystematicStep(mass, cells, count, stop) : 0.0;
  std::vector<Cell> samples;
  samples.reserve(std::min(count, cells.count));
  double until_next = step * (1.0 - rng.Uniform01());  // in (0, step]
  const auto draw = [&](Cell cell) {
    const double q = mass[cell];
    if (q <= 0.0) return;
    if (q >= step) {
      samples.push_back(cell);
      return;
    }
    until_next -= q;
    if (until_next > 0.0) return;
    samples.push_back(cell);
    until_next += step;
  };
  std::size_t tiles = 0;
  bool stopped = false;
  ForEachCellAlongHilbert(mass.width(), mass.height(), draw, [&](Cell low, Cell high) {
    constexpr std::size_t kTilesPerStop = kCellsPerStop / (kHilbertTile * kHilbertTile);
    stopped = stopped || (tiles++ % kTilesPerStop == 0 && Stops(stop));
    return stopped || !cells.bounds.Overlaps({low, {high.x + 1, high.y + 1}});
  });
  return samples;
}

}  // namespace

Grid<float> SamplingMass(const InformationMap& information, const Grid<std::uint8_t>& domain,
                         Cell robot_cell, double uniform_share, const StopFn& stop) {
  Grid<float> mass(domain.geometry(), 0.0F, stop);
  const CellRect bounds = BoundsOf(domain, std::uint8_t{1});
  double total = 0.0;
  std::size_t count = 0;
  ByRows(bounds.min.y, bounds.end.y, bounds.width(), stop, [&](int y) {
    const std::uint8_t* const inside = GridRow(domain, y);
    const float* const value = GridRow(information.value, y);
    double sum = total;
    std::size_t in_row = 0;
    for (int x = bounds.min.x; x < bounds.end.x; ++x) {
      if (inside[x] == 0) continue;
      sum += static_cast<double>(value[x]);
      ++in_row;
    }
    total = sum;
    count += in_row;
  });
  auto cells = static_cast<double>(count);
  if (domain.At(robot_cell, 0) != 0) {
    total -= information.value[robot_cell];
    cells -= 1.0;
  }
  if (cells <= 0.0) return mass;
  const bool no_information = total <= 0.0;
  const auto per_information =
      no_information ? 0.0F : static_cast<float>((1.0 - uniform_share) / total);
  const auto per_cell = static_cast<float>((no_information ? 1.0 : uniform_share) / cells);
  ByRows(bounds.min.y, bounds.end.y, bounds.width(), stop, [&](int y) {
    const std::uint8_t* const inside = GridRow(domain, y);
    const float* const value = GridRow(information.value, y);
    float* const row = GridRow(mass, y);
    for (int x = bounds.min.x; x < bounds.end.x; ++x) {  // Eq. (14)
      row[x] = per_information * value[x] + per_cell;
    }
    for (int x = bounds.min.x; x < bounds.end.x; ++x) row[x] = inside[x] != 0 ? row[x] : 0.0F;
  });
  if (mass.Contains(robot_cell)) mass[robot_cell] = 0.0F;
  return mass;
}

std::vector<Cell> DrawSamples(const Grid<float>& mass, int count, SamplingKind kind, Rng& rng,
                              const StopFn& stop) {
  const auto wanted = static_cast<std::size_t>(std::max(count, 0));
  return kind == SamplingKind::kIid ? DrawIid(mass, wanted, rng, stop)
                                    : DrawSystematic(mass, wanted, rng, stop);
}

}  // namespace plumescout
