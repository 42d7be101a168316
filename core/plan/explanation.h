// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/types/options.h"
#include "core/types/plan.h"

namespace plumescout {

// One sentence for an operator: where the plan leads and why there by options.selection_rule, or
// why the robot stays.
std::string Explain(const Plan& plan, const PlanningOptions& options);

}  // namespace plumescout
