// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/information_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/grid/mask.h"
#include "core/grid/padded.h"
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
    const float known_ppm = std::abs(mean_ppm) < kInfinity ? mean_ppm : prior_mean_ppm_;
    const float known_ppm2 =
        std::abs(variance_ppm2) < kInfinity ? variance_ppm2 : prior_variance_ppm2_;
    const float mean = std::max(0.0F, known_ppm) * mean_scale_;
    return mean + beta_ * std::min(variance_limit_, known_ppm2 * variance_scale_);
  }

 private:
  float prior_mean_ppm_;
  float prior_variance_ppm2_;
  float mean_scale_;
  float variance_scale_;
  float variance_limit_;
  float beta_;
};

// Of I, over traversable cells.
struct Range {
  float low = kInfinity;
  float high = -kInfinity;

  bool empty() const { return low > high; }
  bool flat() const {
    return !(high - low > kFlatContrast * std::max(std::abs(low), std::abs(high)));
  }
};

// Finds the range of values, passing over those that are infinite.
class RangeFinder {
 public:
  RangeFinder() {
    low_.fill(kInfinity);
    high_.fill(-kInfinity);
  }

  void Add(const float* values, int count) {
    int i = 0;
    for (; i + kLanes <= count; i += kLanes) {
      for (int k = 0; k < kLanes; ++k) Take(values[i + k], low_[Lane(k)], high_[Lane(k)]);
    }
    for (; i < count; ++i) Take(values[i], low_[0], high_[0]);
  }

  Range Found() const {
    return {*std::min_element(low_.begin(), low_.end()),
            *std::max_element(high_.begin(), high_.end())};
  }

 private:
  static constexpr int kLanes = 8;  // comparisons that do not wait for each other
  using Lanes = std::array<float, kLanes>;

  static std::size_t Lane(int k) { return static_cast<std::size_t>(k); }
  static void Take(float value, float& low, float& high) {
    low = value < low ? value : low;
    high = value > high && value < kInfinity ? value : high;
  }

  Lanes low_;
  Lanes high_;
};

// Writes I of Eq. (8) into `values` on the traversable cells, all of which lie in `cells`, and
// infinity on the others of these. Returns I_min and I_max.
Range WriteInformation(const InformationMapInput& input, const CellRect& cells,
                       const UpperConfidenceBound& bound, const StopFn& stop, Grid<float>& values) {
  RangeFinder range;
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    const UpperConfidenceBound known_bound = bound;  // which no write can change
    const std::uint8_t* const open = GridRow(input.traversable, y);
    const float* const mean_ppm = GridRow(input.mean_ppm, y);
    const float* const variance_ppm2 = GridRow(input.variance_ppm2, y);
    float* const row = GridRow(values, y);
    for (int x = cells.min.x; x < cells.end.x; ++x) {
      row[x] = known_bound(mean_ppm[x], variance_ppm2[x]);
    }
    for (int x = cells.min.x; x < cells.end.x; ++x) row[x] = open[x] != 0 ? row[x] : kInfinity;
    range.Add(row + cells.min.x, cells.width());
  });
  return range.Found();
}

// Eq. (10) and (11) of one cell.
class Scale {
 public:
  explicit Scale(const Range& range)
      : low_(range.low),
        scale_(range.flat() ? 0.0F : 1.0F / (range.high - range.low)),
        offset_(range.flat() ? kFlatInformation : 0.0F) {}

  float Value(float information) const {
    return std::min(1.0F, std::max(0.0F, (information - low_) * scale_ + offset_));
  }
  static float Penalty(float value) { return std::max(1.0F - value, kMinPenalty); }

 private:
  static constexpr float kFlatInformation = 0.5F;

  float low_;
  float scale_;
  float offset_;
};

// Turns what WriteInformation wrote into I-hat and P.
void WritePenalty(const Grid<std::uint8_t>& traversable, const CellRect& cells, const Scale& scale,
                  const StopFn& stop, InformationMap& information) {
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    const Scale known_scale = scale;  // which no write can change
    const std::uint8_t* const open = GridRow(traversable, y);
    float* const values = GridRow(information.value, y);
    float* const penalties = GridRow(information.penalty, y);
    for (int x = cells.min.x; x < cells.end.x; ++x) values[x] = known_scale.Value(values[x]);
    for (int x = cells.min.x; x < cells.end.x; ++x) penalties[x] = Scale::Penalty(values[x]);
    for (int x = cells.min.x; x < cells.end.x; ++x) {
      penalties[x] = open[x] != 0 ? penalties[x] : kInfinity;
      values[x] = open[x] != 0 ? values[x] : 0.0F;
    }
  });
}

}  // namespace

InformationMap MakeInformationMap(const InformationMapInput& input, const PlanningOptions& options,
                                  const StopFn& stop) {
  InformationMap information;
  const UpperConfidenceBound bound(input, options, stop);
  const CellRect cells = BoundsOf(input.traversable, std::uint8_t{1});
  information.value = Grid<float>(input.traversable.geometry(), 0.0F, stop);
  const Range range = WriteInformation(input, cells, bound, stop, information.value);
  information.flat = range.flat();
  information.penalty = Grid<float>(input.traversable.geometry(), kInfinity, stop);
  const Scale scale(range);
  WritePenalty(input.traversable, cells, scale, stop, information);
  // P falls as I grows.
  if (!range.empty()) information.min_penalty = Scale::Penalty(scale.Value(range.high));
  return information;
}

}  // namespace plumescout
