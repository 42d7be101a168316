// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/relevance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/belief/objective_cells.h"
#include "core/gas/noise_scale.h"
#include "core/grid/padded.h"

namespace plumescout {
namespace {

constexpr float kErrorShare = 0.5F;

// Concentration above the background from which a cell surely holds gas, ppm, > 0.
float SureGas_ppm(const MissionOptions& options) {
  const FrontierOptions& frontier = options.frontier;
  constexpr double kTwice = 2.0;
  const double above_ppm =
      frontier.fixed_gas_threshold_ppm.value_or(0.0) - options.gas.background_mean_ppm;
  const bool fixed = frontier.fixed_gas_threshold_ppm.has_value() && above_ppm > 0.0;
  return static_cast<float>(fixed ? above_ppm : kTwice * frontier.min_gas_threshold_ppm);
}

// Of those that are no NaN; -infinity without any.
float Greatest_ppm(const std::vector<float>& values_ppm, const StopFn& stop) {
  constexpr std::size_t kLanes = 8;  // comparisons that do not wait for each other
  std::array<float, kLanes> greatest_ppm;
  greatest_ppm.fill(-std::numeric_limits<float>::infinity());
  InPieces(values_ppm.size(), stop, [&](std::size_t first, std::size_t end) {
    std::size_t i = first;
    for (; i + kLanes <= end; i += kLanes) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        const float value_ppm = values_ppm[i + k];
        greatest_ppm[k] = value_ppm > greatest_ppm[k] ? value_ppm : greatest_ppm[k];
      }
    }
    for (; i < end; ++i) {
      if (values_ppm[i] > greatest_ppm[0]) greatest_ppm[0] = values_ppm[i];
    }
  });
  return *std::max_element(greatest_ppm.begin(), greatest_ppm.end());
}

// How far above its mean a cell may be: the root of what variances of the model are scaled by,
// LevelScale.
struct Bound {
  const Grid<float>& variance_ppm2;
  float clean_scale;
  float scale_per_ppm;  // of the deviation
};

std::optional<Bound> BoundOf(const Belief& belief) {
  const GasOptions& gas = belief.options->gas;
  if (belief.gas_weight_variance_ppm2 == nullptr || !HasNoiseByLevel(gas)) return std::nullopt;
  const double clean_scale = LevelScale(gas, 0.0);
  const double beside = belief.gas_quality.clean_air_scale / clean_scale;
  return Bound{*belief.gas_weight_variance_ppm2,
               static_cast<float>(belief.gas_quality.clean_air_scale),
               static_cast<float>(beside * (LevelScale(gas, 1.0) - clean_scale))};
}

// Of what cells hold: their means, and with `bound`, which may be null, that much more.
std::vector<float> RelevanceOf(const Grid<float>& mean_ppm, const Bound* bound,
                               const MissionOptions& options, const CellRect& cells,
                               const StopFn& stop) {
  const auto background_ppm = static_cast<float>(options.gas.background_mean_ppm);
  const float sure_ppm = SureGas_ppm(options);
  const float greatest_ppm =
      std::max(sure_ppm, Greatest_ppm(mean_ppm.values(), stop) - background_ppm);
  const auto width = static_cast<std::size_t>(cells.width());
  std::vector<float> gas_ppm(width);
  std::vector<float> relevance;
  relevance.reserve(cells.size());
  // Loops of few operations each, that the compiler takes for several cells at once.
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    std::copy_n(GridRow(mean_ppm, y) + cells.min.x, width, gas_ppm.begin());
    if (bound != nullptr) {
      const float* const row_ppm2 = GridRow(bound->variance_ppm2, y) + cells.min.x;
      for (std::size_t x = 0; x < width; ++x) {
        const float scale =
            bound->clean_scale + bound->scale_per_ppm * std::abs(gas_ppm[x] - background_ppm);
        gas_ppm[x] += std::sqrt(scale * row_ppm2[x]);
      }
    }
    for (float& ppm : gas_ppm) {
      const float above_ppm = ppm - background_ppm;
      ppm = above_ppm > 0.0F ? above_ppm : 0.0F;  // where it is NaN too
    }
    relevance.resize(relevance.size() + width);
    float* const to = relevance.data() + relevance.size() - width;
    for (std::size_t x = 0; x < width; ++x) to[x] = std::min(1.0F, gas_ppm[x] / sure_ppm);
    for (float& ppm : gas_ppm) ppm = std::min(1.0F, ppm / greatest_ppm);
    for (std::size_t x = 0; x < width; ++x) {
      to[x] = kCleanRelevance + (1.0F - kCleanRelevance) * to[x] * to[x] + kErrorShare * gas_ppm[x];
    }
  });
  return relevance;
}

}  // namespace

std::vector<float> Relevance(const Grid<float>& mean_ppm, const MissionOptions& options,
                             const CellRect& cells, const StopFn& stop) {
  return RelevanceOf(mean_ppm, nullptr, options, cells, stop);
}

std::vector<float> Relevance(const Grid<float>& mean_ppm, const MissionOptions& options) {
  return Relevance(mean_ppm, options, WholeRaster(mean_ppm.geometry()));
}

std::vector<float> Relevance(const Belief& belief, const CellRect& cells, const StopFn& stop) {
  const std::optional<Bound> bound = BoundOf(belief);
  std::vector<float> relevance =
      RelevanceOf(*belief.gas_mean_ppm, bound ? &*bound : nullptr, *belief.options, cells, stop);
  if (belief.options->objective.kind == ObjectiveKind::kCompleteMap) return relevance;
  if (Stops(stop)) return relevance;
  const Grid<std::uint8_t> all(belief.geometry(), std::uint8_t{1});
  const ObjectiveCells judged = JudgeCells(belief, all, stop);
  float* to = relevance.data();
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    const float* const margins = GridRow(judged.margin, y) + cells.min.x;
    for (int x = 0; x < cells.width(); ++x) {
      if (!(margins[x] < judged.needed)) to[x] = 0.0F;
    }
    to += cells.width();
  });
  return relevance;
}

std::vector<float> Relevance(const Belief& belief) {
  return Relevance(belief, WholeRaster(belief.geometry()));
}

}  // namespace plumescout
