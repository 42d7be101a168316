// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "core/types/error_reason.h"

namespace plumescout::client {

// Reasons that a client acts on. They are the ErrorInfo reasons of the wire.
using reason::kLeaseHeld;
using reason::kLeaseSuperseded;
using reason::kSequenceGap;
using reason::kStoreRolledBack;

using plumescout::ErrorReason;

// Whether the same call may succeed later without a change on our side: the link or the server is
// down, busy or restarting.
bool IsRetriable(const absl::Status& status);

// How long the server asks to be left alone before the next try; 0 if it does not say, and never
// more than half a minute.
absl::Duration RetryDelayOf(const absl::Status& status);

// What a server that was set back (STORE_ROLLED_BACK) holds of the robot's log: that many
// observations. 0 if it does not say.
std::int64_t RolledBackTo(const absl::Status& status);

// The fields that a server refused, as it names them: "options.planning.speed_mps". None of an
// error that is about no field.
std::vector<std::string> RefusedFields(const absl::Status& status);

}  // namespace plumescout::client
