// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/frontier/gas_frontier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/frontier/cluster.h"
#include "core/frontier/goal_cells.h"
#include "core/grid/flood.h"
#include "core/grid/mask.h"
#include "core/grid/padded.h"
#include "core/types/quantile.h"

namespace plumescout {
namespace {

constexpr std::uint8_t kOther = 0;     // not free, or observed and not critical
constexpr std::uint8_t kUnseen = 1;    // C_gas,unk: free, not observed
constexpr std::uint8_t kWaiting = 2;   // C_gf, Eq. (21), in no cluster yet
constexpr std::uint8_t kTaken = 3;     // C_gf, phi_gf of Alg. 2
constexpr std::uint8_t kCritical = 4;  // C_crit, Eq. (19)
constexpr std::uint8_t kVisited = 5;   // C_crit, phi_v of Alg. 2

struct Thresholds {
  double observed_variance_ppm2;
  double gas_ppm;
};

// NaN compares false: neither observed nor critical.
bool IsObserved(CellState state, float variance_ppm2, double observed_variance_ppm2) {
  return state == CellState::kFree && static_cast<double>(variance_ppm2) <= observed_variance_ppm2;
}

double PercentileShare(const FrontierOptions& options) {
  constexpr double kPercent = 0.01;
  return kPercent * options.gas_percentile;
}

// Calls visit(mean_ppm, counts) for these cells, with 1 for observed ones that have a mean, else 0.
template <typename Visit>
void ForEachMean(const GasFrontierInput& input, const CellRect& cells,
                 double observed_variance_ppm2, const StopFn& stop, const Visit& visit) {
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    const CellState* const state = GridRow(input.states, y);
    const float* const mean_ppm = GridRow(input.mean_ppm, y);
    const float* const variance_ppm2 = GridRow(input.variance_ppm2, y);
    for (int x = cells.min.x; x < cells.end.x; ++x) {
      const bool is_observed = IsObserved(state[x], variance_ppm2[x], observed_variance_ppm2);
      visit(mean_ppm[x], int{is_observed} & int{!std::isnan(mean_ppm[x])});
    }
  });
}

// Whether the percentile is less than the minimum, since so many of the means are. This takes much
// less time than the percentile.
bool IsBelowMinimum(const GasFrontierInput& input, const CellRect& cells,
                    double observed_variance_ppm2, const FrontierOptions& options,
                    const StopFn& stop) {
  std::int64_t observed = 0;
  std::int64_t below = 0;
  ForEachMean(input, cells, observed_variance_ppm2, stop, [&](float mean_ppm, int counts) {
    observed += counts;
    below += counts & int{static_cast<double>(mean_ppm) < options.min_gas_threshold_ppm};
  });
  const double rank = PercentileShare(options) * static_cast<double>(observed - 1);
  return static_cast<double>(below) > rank + 1.0;  // both means that it lies between are
}

// The cells of the map that are free lie in `cells`.
Padded<std::uint8_t> Classify(const GasFrontierInput& input, const CellRect& cells,
                              const Thresholds& thresholds, const StopFn& stop) {
  Padded<std::uint8_t> marks(cells, kOther, kOther);
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    const CellState* state = GridRow(input.states, y) + cells.min.x;
    const float* mean_ppm = GridRow(input.mean_ppm, y) + cells.min.x;
    const float* variance_ppm2 = GridRow(input.variance_ppm2, y) + cells.min.x;
    std::uint8_t* mark = marks.Row(y);
    for (int x = 0; x < cells.width(); ++x) {
      if (state[x] != CellState::kFree) continue;
      if (!IsObserved(state[x], variance_ppm2[x], thresholds.observed_variance_ppm2)) {
        mark[x] = kUnseen;
      } else if (static_cast<double>(mean_ppm[x]) >= thresholds.gas_ppm) {  // Eq. (18)
        mark[x] = kCritical;
      }
    }
  });
  return marks;
}

// Marks C_gf, Eq. (20)-(21): the predicate of Alg. 3 for all cells at once.
void MarkFrontierCells(const CellRect& cells, const StopFn& stop, Padded<std::uint8_t>& marks) {
  const auto offsets = marks.NeighbourOffsets();
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    const int begin = marks.IndexOf({cells.min.x, y});
    for (int cell = begin; cell < begin + cells.width(); ++cell) {
      if (marks[cell] != kCritical) continue;
      for (const int offset : offsets) {
        if (marks[cell + offset] == kUnseen) marks[cell + offset] = kWaiting;
      }
    }
  });
}

// Where the outer wavefront begins, as indices of `marks`. kLocal: the starts in gas, observed or
// not, Alg. 2 lines 2-4. kReachable: every critical cell that a start reaches over free cells.
std::vector<int> WavefrontSeeds(const GasFrontierInput& input, const CellRect& cells,
                                const Padded<std::uint8_t>& marks, double gas_threshold_ppm,
                                const std::vector<Cell>& starts, WgfdScope scope,
                                const StopFn& stop) {
  std::vector<int> seeds;
  if (scope == WgfdScope::kLocal) {
    for (const Cell start : starts) {
      if (input.states.At(start, CellState::kUnknown) == CellState::kFree &&
          static_cast<double>(input.mean_ppm[start]) >= gas_threshold_ppm) {
        seeds.push_back(marks.IndexOf(start));
      }
    }
    return seeds;
  }
  const Grid<std::uint8_t> reached =
      ReachableCells(MaskOf(input.states, CellState::kFree), FreeStarts(input.states, starts),
                     Connectivity::kEightNoCornerCut, stop);
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    const std::uint8_t* const reached_row = GridRow(reached, y) + cells.min.x;
    const int begin = marks.IndexOf({cells.min.x, y});
    for (int x = 0; x < cells.width(); ++x) {
      if (reached_row[x] != 0 && marks[begin + x] == kCritical) seeds.push_back(begin + x);
    }
  });
  return seeds;
}

}  // namespace

double ObservedVariance_ppm2(const FrontierOptions& options, const GasOptions& gas) {
  return options.observed_variance_ppm2.value_or(options.observed_variance_ratio *
                                                 OpenLatticeVariance_ppm2(gas));
}

double GasThreshold_ppm(const GasFrontierInput& input, double observed_variance_ppm2,
                        const FrontierOptions& options, const StopFn& stop) {
  if (options.fixed_gas_threshold_ppm) return *options.fixed_gas_threshold_ppm;
  const CellRect cells = BoundsOf(input.states, CellState::kFree);
  if (IsBelowMinimum(input, cells, observed_variance_ppm2, options, stop)) {
    return options.min_gas_threshold_ppm;
  }
  std::vector<float> means_ppm;
  ForEachMean(input, cells, observed_variance_ppm2, stop, [&](float mean_ppm, int counts) {
    if (counts != 0) means_ppm.push_back(mean_ppm);
  });
  if (means_ppm.empty() || Stops(stop)) return options.min_gas_threshold_ppm;
  const double percentile_ppm = Quantile(std::move(means_ppm), PercentileShare(options));
  return std::max(percentile_ppm, options.min_gas_threshold_ppm);
}

std::vector<Frontier> FindGasClusters(const GasFrontierInput& input, double observed_variance_ppm2,
                                      double gas_threshold_ppm, const std::vector<Cell>& starts,
                                      const FrontierOptions& options, const StopFn& stop) {
  const GridGeometry& geometry = input.states.geometry();
  const CellRect cells = BoundsOf(input.states, CellState::kFree);
  Padded<std::uint8_t> marks =
      Classify(input, cells, {observed_variance_ppm2, gas_threshold_ppm}, stop);
  MarkFrontierCells(cells, stop, marks);
  const auto offsets = marks.NeighbourOffsets();
  const ClusterRule rule = {FrontierKind::kGas, kWaiting, kTaken, options.min_gas_cell_count};
  std::vector<Frontier> frontiers;
  std::vector<int> queue =
      WavefrontSeeds(input, cells, marks, gas_threshold_ppm, starts, options.wgfd_scope, stop);
  for (const int seed : queue) {
    if (marks[seed] == kCritical) marks[seed] = kVisited;
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {  // [XIT] Alg. 2 lines 8-26
    if (i % kCellsPerStop == 0 && Stops(stop)) break;
    for (const int offset : offsets) {
      const int neighbour = queue[i] + offset;
      if (marks[neighbour] == kWaiting) {
        frontiers.push_back(TakeCluster(geometry, rule, neighbour, marks));
      } else if (marks[neighbour] == kCritical) {
        marks[neighbour] = kVisited;
        queue.push_back(neighbour);
      }
    }
  }
  return frontiers;
}

std::vector<Frontier> FindGasFrontiers(const GasFrontierInput& input, double observed_variance_ppm2,
                                       double gas_threshold_ppm, const std::vector<Cell>& starts,
                                       const FrontierOptions& options) {
  std::vector<Frontier> frontiers =
      FindGasClusters(input, observed_variance_ppm2, gas_threshold_ppm, starts, options);
  FindGoalCells(input.states, input.traversable, starts, frontiers);
  return frontiers;
}

}  // namespace plumescout
