// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/statistics.h"

#include <algorithm>
#include <bit>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "core/types/quantile.h"
#include "core/types/rng.h"

namespace plumescout::lab {
namespace {

constexpr std::size_t kExactPairs = 20;
constexpr std::uint64_t kDraws = 1'000'000;
// Sums that differ by rounding alone count as equal.
constexpr double kRounding = 1e-9;

// Share of the 2^n sign patterns with |sum| >= `limit`. Walks them in Gray code, one change each.
double ExactShare(std::vector<double> differences, double sum, double limit) {
  const std::uint64_t patterns = std::uint64_t{1} << differences.size();
  std::uint64_t hits = 0;
  for (std::uint64_t k = 1; k <= patterns; ++k) {
    if (std::abs(sum) >= limit) ++hits;
    double& flipped =
        differences[static_cast<std::size_t>(std::countr_zero(k)) % differences.size()];
    sum -= 2.0 * flipped;
    flipped = -flipped;
  }
  return static_cast<double>(hits) / static_cast<double>(patterns);
}

double DrawnShare(const std::vector<double>& differences, double limit) {
  Rng rng(1);
  std::uint64_t hits = 1;  // the pattern that was seen is one of them
  for (std::uint64_t k = 0; k < kDraws; ++k) {
    double sum = 0.0;
    for (const double difference : differences) {
      sum += rng.Below(2) == 0 ? difference : -difference;
    }
    if (std::abs(sum) >= limit) ++hits;
  }
  return static_cast<double>(hits) / static_cast<double>(kDraws + 1);
}

}  // namespace

Spread SpreadOf(std::span<const double> values) {
  Spread spread;
  spread.count = values.size();
  const auto n = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += value;
  spread.mean = values.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / n;
  if (values.size() < 2) return spread;
  double squares = 0.0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  spread.stddev = std::sqrt(squares / (n - 1.0));
  constexpr double kUpperTail = 0.975;
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), kUpperTail);
  spread.half_95 = t * spread.stddev / std::sqrt(n);
  return spread;
}

PairedRatio PairedRatioOf(std::span<const double> a, std::span<const double> b) {
  std::vector<double> logs;
  for (std::size_t i = 0; i < a.size(); ++i) logs.push_back(std::log(a[i] / b[i]));
  const Spread spread = SpreadOf(logs);
  return {std::exp(spread.mean), std::exp(spread.mean - spread.half_95),
          std::exp(spread.mean + spread.half_95)};
}

Interval BootstrapInterval(std::size_t count,
                           const std::function<double(std::span<const std::size_t>)>& figure) {
  constexpr int kResamples = 2'000;
  constexpr double kTail = 0.025;
  Rng rng(1);
  std::vector<double> figures;
  std::vector<std::size_t> worlds(count);
  for (int k = 0; k < kResamples; ++k) {
    for (std::size_t& world : worlds) world = static_cast<std::size_t>(rng.Below(count));
    const double value = figure(worlds);
    if (std::isfinite(value)) figures.push_back(value);
  }
  if (figures.empty()) {
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  }
  std::sort(figures.begin(), figures.end());
  const auto tail = static_cast<std::size_t>(kTail * static_cast<double>(figures.size()));
  return {figures[tail], figures[figures.size() - 1 - tail]};
}

double PairedPValue(std::span<const double> a, std::span<const double> b) {
  if (a.empty()) return 1.0;
  std::vector<double> differences;
  double sum = 0.0;
  double scale = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differences.push_back(a[i] - b[i]);
    sum += differences.back();
    scale += std::abs(differences.back());
  }
  const double limit = std::abs(sum) - kRounding * scale;
  return a.size() <= kExactPairs ? ExactShare(differences, sum, limit)
                                 : DrawnShare(differences, limit);
}

Reduction ReductionOf(std::span<const double> values, std::span<const double> baseline) {
  constexpr int kResamples = 10'000;
  constexpr double kPercent = 100.0;
  constexpr double kTail = 0.025;
  const auto percent = [](double sum, double base) {
    return kPercent * (base - sum) / std::abs(base);
  };
  Reduction reduction;
  reduction.percent = percent(std::accumulate(values.begin(), values.end(), 0.0),
                              std::accumulate(baseline.begin(), baseline.end(), 0.0));
  Rng rng(1);
  std::vector<double> draws;
  for (int k = 0; k < kResamples; ++k) {
    double sum = 0.0;
    double base = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto pair = static_cast<std::size_t>(rng.Below(values.size()));
      sum += values[pair];
      base += baseline[pair];
    }
    draws.push_back(percent(sum, base));
  }
  reduction.low_95 = Quantile(draws, kTail);
  reduction.high_95 = Quantile(draws, 1.0 - kTail);
  return reduction;
}

ShareInterval WilsonInterval(int hits, int trials) {
  constexpr double kZ = 1.959964;  // of the standard normal, 97.5 %
  const double n = trials;
  const double share = hits / n;
  const double spread = kZ * std::sqrt(share * (1.0 - share) / n + kZ * kZ / (4.0 * n * n));
  const double middle = share + kZ * kZ / (2.0 * n);
  const double scale = 1.0 + kZ * kZ / n;
  return {std::max(0.0, (middle - spread) / scale), std::min(1.0, (middle + spread) / scale)};
}

}  // namespace plumescout::lab
