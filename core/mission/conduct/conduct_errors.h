// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/status.h"
#include "core/types/ids.h"

namespace plumescout {

// The typed errors of whoever runs missions (core/types/error_reason.h); Mission itself makes
// SEQUENCE_GAP.

absl::Status MissionNotFound(const MissionId& mission);
absl::Status MissionExists(const MissionId& mission);
// It plans nothing until it is resumed.
absl::Status MissionPaused(const MissionId& mission);
// Nothing changes it any more.
absl::Status MissionFinished(const MissionId& mission);
absl::Status RobotNotFound(const RobotId& robot);
// Tells to try again after `free_in_ns`.
absl::Status LeaseHeld(const RobotId& robot, std::int64_t free_in_ns);
absl::Status LeaseSuperseded(const RobotId& robot);
// A newer stream of the same client took the place of this one.
absl::Status StreamReplaced(const RobotId& robot);
// Tells to try again soon.
absl::Status CreditExceeded(std::int64_t sequence, std::int64_t credit_sequence);

}  // namespace plumescout
