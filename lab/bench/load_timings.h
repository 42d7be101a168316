// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "core/types/ids.h"

namespace plumescout::lab {

// What a server says of how long a mission's gas posterior takes; NaN where it has no sample.
struct LoadTimings {
  double update_wall_ms_p50 = 0.0;
  double update_wall_ms_p99 = 0.0;
  // From the acknowledgement of a reading until it is in the posterior of a published belief.
  double staleness_wall_ms_p50 = 0.0;
  double staleness_wall_ms_p99 = 0.0;
};

absl::StatusOr<LoadTimings> AskLoadTimings(const std::string& target, const MissionId& mission);

}  // namespace plumescout::lab
