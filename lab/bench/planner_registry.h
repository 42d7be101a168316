// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/plan/paths/path_planner.h"
#include "core/types/options.h"

namespace plumescout::lab {

// A planner under the name of its row.
struct RegisteredPlanner {
  std::string name;
  std::unique_ptr<const PathPlanner> planner;
  CostKind cost = CostKind::kUcb;  // that it searches by; all are judged by the same
  bool is_rival = false;           // of another library
};

// Every planner there is, to be run on the same work. Ours: XIT as published, as we drive it, and
// its tree alone, MIT's search, the exact grid search, and anytime XIT until it gains no more.
// Rivals: those of ompl_planners with budgets from a first path to the quality of the grid's
// optimum; the number is that of samples.
std::vector<RegisteredPlanner> PlannerRegistry();

}  // namespace plumescout::lab
