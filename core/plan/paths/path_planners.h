// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/plan/paths/path_planner.h"
#include "core/types/options.h"

namespace plumescout {

// Makes the bare planner of options.paths, or null for kinds it does not know.
using PathPlannerFactory =
    std::function<std::unique_ptr<const PathPlanner>(const PlanningOptions&)>;

// "xit", "grid_exact", ...: how a kind is called in configurations and tables.
absl::string_view PathKindName(PathKind kind);

// The planner of options.paths, guarded and straightened as options say. `others` makes the kinds
// that core does not have. kInvalidArgument if it does not either. REQUIRES:
// Validate(options).ok().
absl::StatusOr<std::unique_ptr<const PathPlanner>> MakePathPlanner(
    const PlanningOptions& options, const PathPlannerFactory& others);

}  // namespace plumescout
