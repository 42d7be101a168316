// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"
#include "absl/strings/string_view.h"

namespace plumescout::client {

// Reasons that a client acts on. They are the ErrorInfo reasons of the wire.
inline constexpr absl::string_view kLeaseSuperseded = "LEASE_SUPERSEDED";
inline constexpr absl::string_view kLeaseHeld = "LEASE_HELD";
inline constexpr absl::string_view kSequenceGap = "SEQUENCE_GAP";
inline constexpr absl::string_view kServerRestarted = "SERVER_RESTARTED";

// The UPPER_SNAKE word with which the message of a typed error begins ("SEQUENCE_GAP: expected 7"),
// or nothing. Every PlannerClient keeps to this form, whatever carries the error.
absl::string_view ErrorReason(const absl::Status& status);

// Whether the same call may succeed later without a change on our side: the link or the server is
// down, busy or restarting.
bool IsRetriable(const absl::Status& status);

}  // namespace plumescout::client
