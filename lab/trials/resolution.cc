// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/resolution.h"

#include <cstddef>
#include <optional>

#include "lab/trials/convergence.h"

namespace plumescout::lab {
namespace {

std::optional<double> ResolveTime_s(const SamplingDrive& drive, const SamplingDrive& sweep) {
  constexpr double kRounding = 1.0 + 1e-9;  // so that the sweep itself comes to its own end
  return TimeBelow_s(drive.errors, kRounding * sweep.errors.back().rmse_ppm);
}

}  // namespace

Resolution Resolve(std::span<const SamplingDrive> drives, std::span<const SamplingDrive> sweeps,
                   double time_limit_s) {
  Resolution resolution;
  double sweeps_s = 0.0;
  double drives_s = 0.0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    sweeps_s += ResolveTime_s(sweeps[i], sweeps[i]).value_or(time_limit_s);
    const std::optional<double> time_s = ResolveTime_s(drives[i], sweeps[i]);
    drives_s += time_s.value_or(time_limit_s);
    if (time_s) ++resolution.resolved;
  }
  resolution.times_faster = sweeps_s / drives_s;
  return resolution;
}

}  // namespace plumescout::lab
