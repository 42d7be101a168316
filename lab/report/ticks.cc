// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/ticks.h"

#include <cmath>

#include "absl/strings/str_format.h"

namespace plumescout::lab {
namespace {

// Round numbers are up to 2.5 times apart: one above the wanted step may be nearer to it.
constexpr double kNearest = 1.5;
constexpr double kRounding = 1e-9;  // of a step, by which computed ticks may miss the ends

}  // namespace

double RoundDown125(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit) + kRounding));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= limit * (1.0 + kRounding)) return factor * power;
  }
  return power;
}

std::vector<double> LinearTicks(double low, double high, int count) {
  const double step = RoundDown125(kNearest * (high - low) / count);
  std::vector<double> ticks;
  const double last = std::floor(high / step + kRounding);
  for (double i = std::ceil(low / step - kRounding); i <= last; i += 1.0)
    ticks.push_back(i * step + 0.0);  // + 0.0: no "-0"
  return ticks;
}

std::vector<double> DecadeTicks(double low, double high) {
  std::vector<double> ticks;
  const double last = std::floor(std::log10(high) + kRounding);
  for (double power = std::ceil(std::log10(low) - kRounding); power <= last; power += 1.0) {
    ticks.push_back(std::pow(10.0, power));
  }
  return ticks;
}

std::string TickLabel(double value) { return absl::StrFormat("%.4g", value); }

}  // namespace plumescout::lab
