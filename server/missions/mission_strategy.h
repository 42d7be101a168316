// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/plan/strategy.h"
#include "core/types/options.h"

namespace plumescout::server {

// Whether missions may plan with the planners of OMPL, which search one at a time in the whole
// process and may hold a thread of the pool for all of their budget.
enum class Rivals { kOff, kOn };

// Whether this server was built with them (CMake's PLUMESCOUT_SERVER_OMPL).
bool HasRivals();

// Whether a server with or without them can be configured so; kInvalidArgument names the option.
absl::Status CheckRivals(bool are_on, bool has_rivals = HasRivals());

// The strategy of a mission with these options. kInvalidArgument if there is none of that name, or
// its paths are a rival's and those are off. REQUIRES: Validate(options).ok(); HasRivals() if `on`.
absl::StatusOr<std::unique_ptr<const Strategy>> MakeMissionStrategy(const PlanningOptions& options,
                                                                    Rivals rivals);

}  // namespace plumescout::server
