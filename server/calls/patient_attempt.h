// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "absl/status/status.h"
#include "server/base/clock.h"
#include "server/calls/service_context.h"

namespace plumescout::server {

// Makes an attempt at a call, and if its mission is RECOVERING again as soon as that is over: at
// most for ServiceLimits::recovery_patience, and not beyond the call's deadline. `over` is called
// once, with what the last attempt said. Both are called here, or later on another thread, and must
// not block; an attempt that fails has done nothing.
void AttemptPatiently(const ServiceContext& context, SteadyTime deadline,
                      std::function<absl::Status()> attempt,
                      std::function<void(const absl::Status&)> over);

}  // namespace plumescout::server
