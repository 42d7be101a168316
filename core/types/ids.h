// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"

namespace plumescout {

using MissionId = std::string;  // [a-z]([a-z0-9-]{0,61}[a-z0-9])?
using RobotId = std::string;    // the same alphabet, unique within a mission
using PlanId = std::int64_t;    // from 1, unique within a mission

// Epochs of robots' logs stay below this, so that clients whose numbers are doubles hold them
// exactly.
inline constexpr std::int64_t kLogEpochEnd = std::int64_t{1} << 53;

// OK if `id` matches [a-z]([a-z0-9-]{0,61}[a-z0-9])?; otherwise kInvalidArgument naming `field`.
absl::Status ValidateId(absl::string_view field, absl::string_view id);

}  // namespace plumescout
