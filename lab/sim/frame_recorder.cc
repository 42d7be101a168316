// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/frame_recorder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace plumescout::lab {
namespace {

// Half a count is an error of 0.025 ppm, below any sensor's limit; the range ends at 3277 ppm.
constexpr double kScale_ppm_per_count = 0.05;

}  // namespace

FrameRecorder::FrameRecorder(const GridGeometry& geometry, std::size_t sources, int frames,
                             double frame_period_s)
    : geometry_(geometry),
      sums_(sources, std::vector<double>(geometry.size())),
      squares_(geometry.size()) {
  series_.dt_s = frame_period_s;
  series_.scale_ppm_per_count = kScale_ppm_per_count;
  series_.counts.reserve(static_cast<std::size_t>(frames) * geometry.size());
}

void FrameRecorder::Add(const std::vector<Grid<float>>& layers) {
  for (std::size_t i = 0; i < geometry_.size(); ++i) {
    double total = 0.0;
    for (std::size_t s = 0; s < layers.size(); ++s) {
      sums_[s][i] += layers[s][i];
      total += layers[s][i];
    }
    squares_[i] += total * total;
    const double counts = std::round(total / kScale_ppm_per_count);
    constexpr double kMaxCount = std::numeric_limits<std::uint16_t>::max();
    series_.counts.push_back(static_cast<std::uint16_t>(std::min(counts, kMaxCount)));
  }
  ++series_.frames;
}

void FrameRecorder::MoveTo(Scene& scene) {
  scene.conc_mean_ppm = Grid<float>(geometry_);
  scene.conc_std_ppm = Grid<float>(geometry_);
  scene.conc_mean_by_source_ppm.assign(sums_.size(), Grid<float>(geometry_));
  for (std::size_t i = 0; i < geometry_.size(); ++i) {
    double mean = 0.0;
    for (std::size_t s = 0; s < sums_.size(); ++s) {
      const double mean_of_source = sums_[s][i] / series_.frames;
      scene.conc_mean_by_source_ppm[s][i] = static_cast<float>(mean_of_source);
      mean += mean_of_source;
    }
    scene.conc_mean_ppm[i] = static_cast<float>(mean);
    const double variance = std::max(0.0, squares_[i] / series_.frames - mean * mean);
    scene.conc_std_ppm[i] = static_cast<float>(std::sqrt(variance));
  }
  scene.series = std::move(series_);
}

}  // namespace plumescout::lab
