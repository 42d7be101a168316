// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "lab/trials/sampling_study.h"

namespace plumescout::lab {

// T_r of [IPP] Table I: how many times sooner than the sweep from the same start a row is as good
// as the sweep is in the end; the paper's limit of 0.0095 is what its sweep ended with.
struct Resolution {
  double times_faster = 0.0;  // mean time of the sweeps over that of the drives
  int resolved = 0;           // drives that came to it
};

// A drive that does not come to it counts with all the time there was, `time_limit_s`, also if the
// drive or its sweep ended before. REQUIRES: as many drives as sweeps, at least one; none without
// errors.
Resolution Resolve(std::span<const SamplingDrive> drives, std::span<const SamplingDrive> sweeps,
                   double time_limit_s);

}  // namespace plumescout::lab
