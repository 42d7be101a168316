// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/team_times.h"

#include <cmath>

namespace plumescout::lab {
namespace {

template <typename IsThere>
ReachedAt ReachedForGood(const std::vector<CurvePoint>& curve, IsThere is_there) {
  std::size_t first = curve.size();
  while (first > 0 && is_there(curve[first - 1].metrics)) --first;
  if (first == curve.size()) return {curve.back().time_s, false};
  return {curve[first].time_s, true};
}

}  // namespace

ReachedAt FallsTo(const std::vector<CurvePoint>& curve, MetricFn metric, double level) {
  return ReachedForGood(curve, [&](const MapMetrics& metrics) { return metric(metrics) <= level; });
}

ReachedAt RisesTo(const std::vector<CurvePoint>& curve, MetricFn metric, double level) {
  return ReachedForGood(curve, [&](const MapMetrics& metrics) { return metric(metrics) >= level; });
}

double LevelAtShare(const std::vector<CurvePoint>& curve, MetricFn metric, double share) {
  const double first = metric(curve.front().metrics);
  return first + share * (metric(curve.back().metrics) - first);
}

double GeometricMean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::log(value);
  return values.empty() ? 1.0 : std::exp(sum / static_cast<double>(values.size()));
}

}  // namespace plumescout::lab
