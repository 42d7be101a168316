// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/status.h"
#include "core/types/observation.h"
#include "core/types/options.h"

namespace plumescout {

// OK if the mission can take the observation; otherwise kInvalidArgument naming field, value and
// limit. Single bad beams of a scan are no fault of the scan. `newest_sample_time_ns`: of the
// mission so far, 0 if none; a clock that leaps ahead of it by more than a day is refused, because
// ageing and expiry go by the newest sample time.
absl::Status CheckObservation(const Observation& observation, const MissionOptions& options,
                              std::int64_t newest_sample_time_ns);

}  // namespace plumescout
