// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/convergence.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plumescout::lab {

std::optional<double> ConvergenceTime_s(const ErrorCurve& errors, double steady_share) {
  if (errors.empty()) return std::nullopt;
  const double final_ppm = errors.back().rmse_ppm;
  const auto is_steady = [&](const ErrorPoint& point) {
    return std::abs(point.rmse_ppm - final_ppm) <= steady_share * final_ppm;
  };
  const auto unsteady = std::find_if_not(errors.rbegin(), errors.rend(), is_steady);
  if (unsteady == errors.rbegin()) return std::nullopt;  // the final value is no number
  return unsteady.base()->time_s;                        // of the point after it
}

std::optional<double> TimeBelow_s(const ErrorCurve& errors, double limit_ppm) {
  const auto below = std::find_if(errors.begin(), errors.end(), [&](const ErrorPoint& point) {
    return point.rmse_ppm < limit_ppm;
  });
  if (below == errors.end()) return std::nullopt;
  return below->time_s;
}

Resolution ResolveAgainst(std::span<const ErrorCurve> drives, std::span<const ErrorCurve> sweeps,
                          double unresolved_s) {
  constexpr double kRounding = 1.0 + 1e-9;  // so that a sweep itself comes to its own end
  Resolution resolution;
  double sweep_s = 0.0;
  double drive_s = 0.0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const double limit_ppm = kRounding * sweeps[i].back().rmse_ppm;
    const std::optional<double> time_s = TimeBelow_s(drives[i], limit_ppm);
    sweep_s += TimeBelow_s(sweeps[i], limit_ppm).value_or(unresolved_s);
    drive_s += time_s.value_or(unresolved_s);
    resolution.resolved += time_s.has_value();
  }
  resolution.times_faster = sweep_s / drive_s;
  return resolution;
}

std::optional<ErrorPoint> FinalError(const ErrorCurve& errors) {
  if (errors.empty()) return std::nullopt;
  return errors.back();
}

std::optional<ErrorPoint> LeastError(const ErrorCurve& errors) {
  if (errors.empty()) return std::nullopt;
  return *std::min_element(
      errors.begin(), errors.end(),
      [](const ErrorPoint& a, const ErrorPoint& b) { return a.rmse_ppm < b.rmse_ppm; });
}

std::vector<double> EvenTimes_s(double end_s, double step_s) {
  constexpr double kRounding = 1e-9;  // of a step: sums of decimals
  std::vector<double> times_s;
  const auto last = static_cast<int>(std::floor(end_s / step_s + kRounding));
  for (int i = 0; i <= last; ++i) times_s.push_back(i * step_s);
  return times_s;
}

ErrorCurve Resampled(const ErrorCurve& errors, std::span<const double> times_s) {
  ErrorCurve resampled;
  std::size_t at = 0;
  for (const double time_s : times_s) {
    while (at + 1 < errors.size() && errors[at + 1].time_s <= time_s) ++at;
    resampled.push_back({time_s, errors[at].rmse_ppm});
  }
  return resampled;
}

ErrorCurve MeanCurve(std::span<const ErrorCurve> curves, std::span<const double> times_s) {
  ErrorCurve mean;
  for (const double time_s : times_s) mean.push_back({time_s, 0.0});
  for (const ErrorCurve& curve : curves) {
    const ErrorCurve resampled = Resampled(curve, times_s);
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean[i].rmse_ppm += resampled[i].rmse_ppm / static_cast<double>(curves.size());
    }
  }
  return mean;
}

}  // namespace plumescout::lab
