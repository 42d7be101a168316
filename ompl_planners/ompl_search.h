// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/paths/path_planner.h"
#include "core/types/options.h"

namespace plumescout {

// The search of an OmplPlanner. Sets OMPL's seed and console output: one call at a time.
// REQUIRES: samples >= 0, a kind of OMPL's.
PathResult SearchWithOmpl(PathKind kind, int samples, const PathProblem& problem) noexcept;

}  // namespace plumescout
