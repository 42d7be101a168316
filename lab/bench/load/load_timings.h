// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/statusor.h"
#include "core/types/ids.h"

namespace plumescout::lab {

// What a server says of a mission, and of how long its gas posterior takes; NaN where it has no
// sample.
struct LoadTimings {
  std::int64_t revision = 0;
  double update_wall_ms_p50 = 0.0;
  double update_wall_ms_p99 = 0.0;
  // From the acknowledgement of a reading until it is in the posterior of a published belief.
  double staleness_wall_ms_p50 = 0.0;
  double staleness_wall_ms_p99 = 0.0;
};

absl::StatusOr<LoadTimings> AskLoadTimings(const std::string& target, const MissionId& mission);

}  // namespace plumescout::lab
