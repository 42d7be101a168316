// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/objective_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/frontier/gas_frontier.h"
#include "core/gas/gas_scale.h"
#include "core/grid/travel_search.h"
#include "core/types/normal.h"

namespace plumescout {
namespace {

constexpr float kNotMeasured = -std::numeric_limits<float>::infinity();
constexpr float kDoesNotCount = std::numeric_limits<float>::quiet_NaN();

// A cell on the scale on which the field is Gaussian.
struct OnFieldScale {
  float mean;
  float variance;
};

// Of y^2 the variance is 4 mean^2 v + 2 v^2: v is its positive root.
OnFieldScale Undo(const GasOptions& gas, float mean_ppm, float variance_ppm2) {
  if (gas.scale == GasScale::kLinear) return {mean_ppm, variance_ppm2};
  const float square = std::max(0.0F, mean_ppm);
  const float half = 0.5F * variance_ppm2;
  return {std::sqrt(square), half / (square + std::sqrt(square * square + half))};
}

class Judge {
 public:
  Judge(const Belief& belief, const Grid<std::uint8_t>& counted, const StopFn& stop)
      : options_(*belief.options),
        states_(*belief.occupancy),
        mean_ppm_(*belief.gas_mean_ppm),
        variance_ppm2_(*belief.Gas(0).published_variance_ppm2()),
        model_variance_ppm2_(*belief.gas_variance_ppm2),
        counted_(counted),
        stop_(stop),
        observed_ppm2_(static_cast<float>(ObservedVariance_ppm2(options_.frontier, options_.gas))),
        threshold_(static_cast<float>(OnScale(options_.gas, options_.objective.threshold_ppm))) {
    cells_.margin = Grid<float>(belief.geometry(), kDoesNotCount);
    cells_.needed = static_cast<float>(NormalQuantile(options_.objective.confidence));
  }

  ObjectiveCells Run() {
    const ObjectiveKind kind = options_.objective.kind;
    if (kind == ObjectiveKind::kFindSources) FindStrongest();
    const bool either_side = kind == ObjectiveKind::kMapAboveThreshold;
    ForEachCell([&](std::size_t i) {
      if (counted_[i] == 0) return;
      cells_.margin[i] = IsMeasured(i) ? MarginAt(i, either_side) : kNotMeasured;
    });
    if (!Stops(stop_)) JudgeBesideMeasured(either_side);
    if (either_side && !Stops(stop_)) PassOverEdges();
    if (cells_.source_found && !Stops(stop_)) PassOverSource();
    return std::move(cells_);
  }

 private:
  template <typename Visit>
  void ForEachCell(const Visit& visit) const {
    InPieces(cells_.margin.size(), stop_, [&visit](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) visit(i);
    });
  }

  // False for NaN, too.
  bool IsMeasured(std::size_t i) const { return model_variance_ppm2_[i] <= observed_ppm2_; }
  OnFieldScale At(std::size_t i) const {
    return Undo(options_.gas, mean_ppm_[i], variance_ppm2_[i]);
  }
  float MarginAt(std::size_t i, bool either_side) const {
    const OnFieldScale cell = At(i);
    if (cells_.source_found) {
      return (strongest_.mean - cell.mean) / std::sqrt(strongest_.variance + cell.variance);
    }
    const float below = (threshold_ - cell.mean) / std::sqrt(cell.variance);
    return either_side ? std::abs(below) : below;
  }

  void FindStrongest() {
    float most = kNotMeasured;
    ForEachCell([&](std::size_t i) {
      if (counted_[i] == 0 || !IsMeasured(i)) return;
      const OnFieldScale cell = At(i);
      const float bound = cell.mean - cells_.needed * std::sqrt(cell.variance);
      if (!(bound > most)) return;
      most = bound;
      strongest_ = cell;
      cells_.strongest = i;
    });
    cells_.source_found = most > threshold_;
  }

  // Visits the cells that lie within radius_m of those of which `is_source` is true, some of these
  // too, by ways through free cells: what is known on one side of a wall says nothing of the other.
  template <typename IsSource, typename Visit>
  void ForEachBeside(const IsSource& is_source, const Visit& visit) const {
    constexpr double kRoundings = 1e-4;  // of a search's ways
    const GridGeometry& geometry = cells_.margin.geometry();
    TravelSearch<float> search(
        geometry, WholeRaster(geometry), Connectivity::kEightNoCornerCut,
        [this](std::size_t i) { return states_[i] == CellState::kFree; }, stop_);
    // Ways lead out over the rim of what is a source: all else within it need not be begun from.
    const auto is_beyond = [&](std::size_t i) {
      return states_[i] == CellState::kFree && !is_source(i);
    };
    const auto width = static_cast<std::size_t>(geometry.width);
    const std::size_t last_row = cells_.margin.size() - width;
    std::vector<SearchSource> sources;
    ForEachCell([&](std::size_t i) {
      if (!is_source(i)) return;
      const std::size_t x = i % width;
      const bool is_rim = (x > 0 && is_beyond(i - 1)) || (x + 1 < width && is_beyond(i + 1)) ||
                          (i >= width && is_beyond(i - width)) ||
                          (i < last_row && is_beyond(i + width));
      if (is_rim) sources.push_back({geometry.CellAtIndex(i)});
    });
    const double radius_m = options_.objective.radius_m * (1.0 + kRoundings);
    double searched_m = 0.0;
    search.Run(std::move(sources), [&] {
      searched_m += geometry.resolution_m;
      return searched_m > radius_m || Stops(stop_);
    });
    ForEachCell([&](std::size_t i) {
      if (search.Travel(geometry.CellAtIndex(i)) <= radius_m) visit(i);
    });
  }

  // In corners, which have fewer neighbours, variances stay larger whoever passes by.
  void JudgeBesideMeasured(bool either_side) {
    ForEachBeside([this](std::size_t i) { return IsMeasured(i); },
                  [&](std::size_t i) {
                    if (cells_.margin[i] != kNotMeasured || std::isnan(mean_ppm_[i])) return;
                    cells_.margin[i] = MarginAt(i, either_side);
                  });
  }

  // What lies at the edge of what is above the threshold is never sure to be on either side.
  void PassOverEdges() {
    ForEachBeside([this](std::size_t i) { return cells_.margin[i] >= cells_.needed; },
                  [this](std::size_t i) { PassOver(i); });
  }
  void PassOverSource() {
    ForEachBeside([this](std::size_t i) { return i == *cells_.strongest; },
                  [this](std::size_t i) { PassOver(i); });
    cells_.margin[*cells_.strongest] = kDoesNotCount;
  }
  // If it is in doubt.
  void PassOver(std::size_t i) {
    const bool is_doubtful = cells_.margin[i] < cells_.needed && cells_.margin[i] != kNotMeasured;
    if (is_doubtful) cells_.margin[i] = kDoesNotCount;
  }

  const MissionOptions& options_;
  const Grid<CellState>& states_;
  const Grid<float>& mean_ppm_;
  const Grid<float>& variance_ppm2_;
  const Grid<float>& model_variance_ppm2_;
  const Grid<std::uint8_t>& counted_;
  const StopFn& stop_;
  const float observed_ppm2_;
  const float threshold_;
  OnFieldScale strongest_ = {0.0F, 0.0F};
  ObjectiveCells cells_;
};

}  // namespace

ObjectiveCells JudgeCells(const Belief& belief, const Grid<std::uint8_t>& counted,
                          const StopFn& stop) {
  return Judge(belief, counted, stop).Run();
}

ObjectiveVerdict VerdictOf(const ObjectiveCells& cells, ObjectiveKind kind, std::size_t cell) {
  const float margin = cells.margin[cell];
  if (std::isnan(margin)) return ObjectiveVerdict::kDoesNotCount;
  if (margin == kNotMeasured) return ObjectiveVerdict::kNotMeasured;
  if (margin >= cells.needed) return ObjectiveVerdict::kDecided;
  const bool is_refuted = kind == ObjectiveKind::kConfirmClean && margin <= -cells.needed;
  return is_refuted ? ObjectiveVerdict::kRefuted : ObjectiveVerdict::kUndecided;
}

}  // namespace plumescout
