// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/resolution.h"

#include <cstddef>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "lab/trials/convergence.h"

namespace plumescout::lab {
namespace {

std::optional<double> ResolveTime_s(const SamplingDrive& drive, const SamplingDrive& sweep,
                                    const std::optional<double>& limit_ppm) {
  constexpr double kRounding = 1.0 + 1e-9;  // so that the sweep itself comes to its own end
  return TimeBelow_s(drive.errors, limit_ppm.value_or(kRounding * sweep.errors.back().rmse_ppm));
}

ResolutionKind KindOf(int resolved, int sweeps_resolved, int drives) {
  if (resolved == 0) return ResolutionKind::kNone;
  if (sweeps_resolved < drives) {
    return resolved < drives ? ResolutionKind::kOpen : ResolutionKind::kAtLeast;
  }
  return resolved < drives ? ResolutionKind::kAtMost : ResolutionKind::kExact;
}

}  // namespace

Resolution Resolve(std::span<const SamplingDrive> drives, std::span<const SamplingDrive> sweeps,
                   double time_limit_s, std::optional<double> limit_ppm) {
  Resolution resolution;
  double sweeps_s = 0.0;
  double drives_s = 0.0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const std::optional<double> sweep_s = ResolveTime_s(sweeps[i], sweeps[i], limit_ppm);
    const std::optional<double> drive_s = ResolveTime_s(drives[i], sweeps[i], limit_ppm);
    sweeps_s += sweep_s.value_or(time_limit_s);
    drives_s += drive_s.value_or(time_limit_s);
    if (sweep_s) ++resolution.sweeps_resolved;
    if (drive_s) ++resolution.resolved;
  }
  resolution.times_faster = sweeps_s / drives_s;
  return resolution;
}

WorldsResolution ResolveWorlds(std::span<const std::vector<SamplingDrive>> drives,
                               std::span<const std::vector<SamplingDrive>> sweeps,
                               double time_limit_s, std::optional<double> limit_ppm) {
  WorldsResolution worlds;
  std::vector<double> times_faster;
  int sweeps_resolved = 0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (drives[i].empty()) continue;
    const Resolution one = Resolve(drives[i], sweeps[i], time_limit_s, limit_ppm);
    times_faster.push_back(one.times_faster);
    worlds.resolved += one.resolved;
    worlds.drives += static_cast<int>(drives[i].size());
    sweeps_resolved += one.sweeps_resolved;
  }
  worlds.times_faster = PairedRatioOf(times_faster, std::vector<double>(times_faster.size(), 1.0));
  worlds.kind = KindOf(worlds.resolved, sweeps_resolved, worlds.drives);
  return worlds;
}

std::string TextOf(const WorldsResolution& resolution) {
  if (resolution.kind == ResolutionKind::kNone) return "N/A";
  const char* sign = "";
  if (resolution.kind == ResolutionKind::kAtMost) sign = "≤ ";
  if (resolution.kind == ResolutionKind::kAtLeast) sign = "≥ ";
  if (resolution.kind == ResolutionKind::kOpen) sign = "~ ";
  const PairedRatio& ratio = resolution.times_faster;
  const std::string text =
      absl::StrFormat("%s%.2f [%.2f, %.2f]", sign, ratio.mean, ratio.low, ratio.high);
  if (resolution.resolved == resolution.drives) return text;
  return absl::StrCat(text, " (", resolution.resolved, " of ", resolution.drives, ")");
}

}  // namespace plumescout::lab
