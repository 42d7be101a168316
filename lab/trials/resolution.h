// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lab/trials/sampling_study.h"
#include "lab/trials/statistics.h"

namespace plumescout::lab {

// T_r of [IPP] Table I: how many times sooner than the sweep from the same start a row's map is
// good enough: as good as that sweep's in the end (the paper's limit of 0.0095 is what its sweep
// ended with), or below a limit.
struct Resolution {
  double times_faster = 0.0;  // mean time of the sweeps over that of the drives
  int resolved = 0;           // drives that came to it
  int sweeps_resolved = 0;
};

// A drive that does not come to it counts with all the time there was, `time_limit_s`, also if the
// drive or its sweep ended before. REQUIRES: as many drives as sweeps, at least one; none without
// errors.
Resolution Resolve(std::span<const SamplingDrive> drives, std::span<const SamplingDrive> sweeps,
                   double time_limit_s, std::optional<double> limit_ppm = std::nullopt);

// The same in several worlds, each with several drives: the geometric mean over the worlds with its
// 95 % interval. What the time limit makes of the mean: a bound if drives, or sweeps, did not come
// to it.
enum class ResolutionKind {
  kExact,
  kAtMost,   // drives did not come to it
  kAtLeast,  // sweeps did not
  kOpen,     // neither: the ratio says little
  kNone,     // no drive came to it: "N/A" of Table I
};
struct WorldsResolution {
  PairedRatio times_faster;
  ResolutionKind kind = ResolutionKind::kExact;
  int resolved = 0;  // drives in all worlds
  int drives = 0;
};
// REQUIRES: as many drives as sweeps in each world; worlds without drives do not count.
WorldsResolution ResolveWorlds(std::span<const std::vector<SamplingDrive>> drives,
                               std::span<const std::vector<SamplingDrive>> sweeps,
                               double time_limit_s, std::optional<double> limit_ppm = std::nullopt);

// "1.48 [1.11, 1.97]", "≤ 0.85 [0.70, 1.10] (6 of 10)", "N/A": with the share that came to it if
// not all did.
std::string TextOf(const WorldsResolution& resolution);

}  // namespace plumescout::lab
