// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"
#include "core/types/error_reason.h"

namespace plumescout::client {

// Reasons that a client acts on. They are the ErrorInfo reasons of the wire.
using reason::kLeaseHeld;
using reason::kLeaseSuperseded;
using reason::kSequenceGap;
using reason::kServerRestarted;

using plumescout::ErrorReason;

// Whether the same call may succeed later without a change on our side: the link or the server is
// down, busy or restarting.
bool IsRetriable(const absl::Status& status);

}  // namespace plumescout::client
