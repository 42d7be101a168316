// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/relevance.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

std::vector<float> Relevance(const Grid<float>& mean_ppm, const MissionOptions& options) {
  const auto background_ppm = static_cast<float>(options.gas.background_mean_ppm);
  const float sure_ppm = SureGas_ppm(options);
  float greatest_ppm = sure_ppm;
  // fmax passes NaN over.
  for (const float mean : mean_ppm.values()) {
    greatest_ppm = std::fmax(greatest_ppm, mean - background_ppm);
  }
  std::vector<float> relevance;
  relevance.reserve(mean_ppm.size());
  for (const float mean : mean_ppm.values()) {
    const float gas_ppm = std::fmax(0.0F, mean - background_ppm);
    const float sure = std::min(1.0F, gas_ppm / sure_ppm);
    relevance.push_back(kCleanRelevance + (1.0F - kCleanRelevance) * sure * sure +
                        kErrorShare * gas_ppm / greatest_ppm);
  }
  return relevance;
}

}  // namespace plumescout
