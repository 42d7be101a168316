// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/kernel_dmv.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr double kCutOff_sigma = 4.0;

// Weights are in units of N(0, sigma): that constant cancels in the quotients and in alpha.
struct Kernel {
  double width_m;
  double confidence_scale;

  double Weight(double distance_m) const {
    const double in_widths = distance_m / width_m;
    return in_widths > kCutOff_sigma ? 0.0 : std::exp(-0.5 * in_widths * in_widths);
  }
  // alpha
  double Confidence(double weights) const {
    const double ratio = weights / confidence_scale;
    return -std::expm1(-ratio * ratio);
  }
};

struct Sample {
  Point2 position;
  double value;
};

// The weighted mean of samples in a cell, as far as they are to be trusted; else the fallback.
class KernelMap {
 public:
  KernelMap(const GridGeometry& geometry, const Kernel& kernel, double fallback)
      : kernel_(kernel), fallback_(fallback), weights_(geometry), sums_(geometry) {}

  void Add(const Sample& sample) {
    const GridGeometry& geometry = weights_.geometry();
    const double reach_m = kCutOff_sigma * kernel_.width_m;
    const Cell low =
        geometry.CellAt({sample.position.x_m - reach_m, sample.position.y_m - reach_m});
    const Cell high =
        geometry.CellAt({sample.position.x_m + reach_m, sample.position.y_m + reach_m});
    for (int y = std::max(low.y, 0); y <= std::min(high.y, geometry.height - 1); ++y) {
      for (int x = std::max(low.x, 0); x <= std::min(high.x, geometry.width - 1); ++x) {
        const double weight = kernel_.Weight(Distance_m(geometry.Center({x, y}), sample.position));
        weights_[Cell{x, y}] += weight;
        sums_[Cell{x, y}] += weight * sample.value;
      }
    }
  }

  double At(Cell cell) const {
    const double weight = weights_.At(cell, 0.0);
    if (weight == 0.0) return fallback_;
    const double confidence = kernel_.Confidence(weight);
    return confidence * sums_[cell] / weight + (1.0 - confidence) * fallback_;
  }

 private:
  Kernel kernel_;
  double fallback_;
  Grid<double> weights_;  // Omega
  Grid<double> sums_;
};

// Of the grid, if it has any.
Cell NearestCell(const GridGeometry& geometry, Point2 point) {
  const Cell cell = geometry.CellAt(point);
  return {std::max(0, std::min(cell.x, geometry.width - 1)),
          std::max(0, std::min(cell.y, geometry.height - 1))};
}

KernelMap MapOf(const std::vector<Sample>& samples, const GridGeometry& geometry,
                const Kernel& kernel) {
  double sum = 0.0;
  for (const Sample& sample : samples) sum += sample.value;
  KernelMap map(geometry, kernel, sum / static_cast<double>(samples.size()));
  for (const Sample& sample : samples) map.Add(sample);
  return map;
}

}  // namespace

absl::Status Validate(const KernelDmvOptions& options) {
  constexpr double kMost = 1e6;
  constexpr double kMostWidth_m = 1000.0;
  constexpr double kLeast = 1e-6;
  return Checker()
      .InRange("kernel_width_m", options.kernel_width_m, kLeast, kMostWidth_m)
      .InRange("confidence_scale", options.confidence_scale, kLeast, kMost)
      .status();
}

absl::Status KernelDmv::Add(Point2 position, const GasReading& reading) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckMappable(position, reading));
  readings_.push_back({position, reading.concentration_ppm});
  return absl::OkStatus();
}

absl::StatusOr<MappedGas> KernelDmv::MapOver(const Grid<CellState>& states) {
  if (readings_.empty()) return absl::FailedPreconditionError("there are no gas readings yet");
  const GridGeometry& geometry = states.geometry();
  const Kernel kernel{options_.kernel_width_m, options_.confidence_scale};
  std::vector<Sample> samples;
  for (const Reading& reading : readings_) {
    samples.push_back({reading.position, reading.concentration_ppm});
  }
  const KernelMap means = MapOf(samples, geometry, kernel);
  for (Sample& sample : samples) {
    const double off = sample.value - means.At(NearestCell(geometry, sample.position));
    sample.value = off * off;
  }
  const KernelMap variances = MapOf(samples, geometry, kernel);
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  MappedGas gas{Grid<float>(geometry, kNone), Grid<float>(geometry, kNone)};
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] != CellState::kFree) continue;
    const Cell cell = geometry.CellAtIndex(i);
    gas.mean_ppm[i] = static_cast<float>(means.At(cell));
    gas.variance_ppm2[i] = static_cast<float>(variances.At(cell));
  }
  return gas;
}

}  // namespace plumescout::lab
