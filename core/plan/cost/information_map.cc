// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/information_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/grid/mask.h"
#include "core/types/cell_rect.h"

namespace plumescout {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Contrast below this share of the map's size is rounding of the posterior, not information.
constexpr float kFlatContrast = 1e-5F;

// Denominator of Eq. (9): over all free cells, inflated zone included, as in the paper.
float MaxMean_ppm(const InformationMapInput& input, const StopFn& stop) {
  constexpr std::size_t kLanes = 8;  // comparisons that do not wait for each other
  std::array<float, kLanes> max_ppm;
  max_ppm.fill(static_cast<float>(input.frontier.min_gas_threshold_ppm));
  const auto take = [](float mean_ppm, float& max) {
    max = mean_ppm > max && mean_ppm < kInfinity ? mean_ppm : max;
  };
  InPieces(input.mean_ppm.size(), stop, [&](std::size_t first, std::size_t end) {
    std::size_t i = first;
    for (; i + kLanes <= end; i += kLanes) {
      for (std::size_t k = 0; k < kLanes; ++k) take(input.mean_ppm[i + k], max_ppm[k]);
    }
    for (; i < end; ++i) take(input.mean_ppm[i], max_ppm[0]);
  });
  return *std::max_element(max_ppm.begin(), max_ppm.end());
}

// Eq. (8) of one cell.
class UpperConfidenceBound {
 public:
  UpperConfidenceBound(const InformationMapInput& input, const PlanningOptions& options,
                       const StopFn& stop)
      : prior_mean_ppm_(static_cast<float>(input.gas.background_mean_ppm)),
        prior_variance_ppm2_(static_cast<float>(OpenLatticeVariance_ppm2(input.gas))),
        mean_scale_(1.0F / MaxMean_ppm(input, stop)),
        variance_scale_(options.raw_variance ? 1.0F : 1.0F / prior_variance_ppm2_),
        variance_limit_(options.raw_variance ? kInfinity : 1.0F),
        beta_(static_cast<float>(options.beta)) {}

  float operator()(float mean_ppm, float variance_ppm2) const {
    if (!std::isfinite(mean_ppm)) mean_ppm = prior_mean_ppm_;
    if (!std::isfinite(variance_ppm2)) variance_ppm2 = prior_variance_ppm2_;
    const float mean = std::max(0.0F, mean_ppm) * mean_scale_;
    return mean + beta_ * std::min(variance_limit_, variance_ppm2 * variance_scale_);
  }

 private:
  float prior_mean_ppm_;
  float prior_variance_ppm2_;
  float mean_scale_;
  float variance_scale_;
  float variance_limit_;
  float beta_;
};

struct Range {
  float low = kInfinity;
  float high = -kInfinity;

  bool flat() const {
    return !(high - low > kFlatContrast * std::max(std::abs(low), std::abs(high)));
  }
};

// Calls visit(index) for each, row by row.
template <typename Visit>
void ForEachTraversable(const Grid<std::uint8_t>& traversable, const StopFn& stop,
                        const Visit& visit) {
  const CellRect cells = BoundsOf(traversable, std::uint8_t{1});
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    const std::size_t begin = traversable.geometry().Index({cells.min.x, y});
    const std::size_t end = begin + static_cast<std::size_t>(cells.width());
    for (std::size_t i = begin; i < end; ++i) {
      if (traversable[i] != 0) visit(i);
    }
  });
}

// Writes I of Eq. (8) into `values` on the traversable cells and returns I_min and I_max.
Range WriteInformation(const InformationMapInput& input, const UpperConfidenceBound& bound,
                       const StopFn& stop, Grid<float>& values) {
  Range range;
  ForEachTraversable(input.traversable, stop, [&](std::size_t i) {
    values[i] = bound(input.mean_ppm[i], input.variance_ppm2[i]);
    range.low = std::min(range.low, values[i]);
    range.high = std::max(range.high, values[i]);
  });
  return range;
}

// Eq. (10) and (11), on I in the place of I-hat.
void WritePenalty(const Grid<std::uint8_t>& traversable, const Range& range, const StopFn& stop,
                  InformationMap& information) {
  constexpr float kFlatInformation = 0.5F;
  const float scale = information.flat ? 0.0F : 1.0F / (range.high - range.low);
  ForEachTraversable(traversable, stop, [&](std::size_t i) {
    float& value = information.value[i];
    value =
        information.flat ? kFlatInformation : std::clamp((value - range.low) * scale, 0.0F, 1.0F);
    information.penalty[i] = std::max(1.0F - value, kMinPenalty);
    information.min_penalty = std::min(information.min_penalty, information.penalty[i]);
  });
}

}  // namespace

InformationMap MakeInformationMap(const InformationMapInput& input, const PlanningOptions& options,
                                  const StopFn& stop) {
  InformationMap information;
  const UpperConfidenceBound bound(input, options, stop);
  information.value = Grid<float>(input.traversable.geometry(), 0.0F, stop);
  const Range range = WriteInformation(input, bound, stop, information.value);
  information.flat = range.flat();
  information.penalty = Grid<float>(input.traversable.geometry(), kInfinity, stop);
  WritePenalty(input.traversable, range, stop, information);
  return information;
}

}  // namespace plumescout
