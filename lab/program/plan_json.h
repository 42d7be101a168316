// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "core/types/plan.h"

namespace plumescout::lab {

// The plan with every number in it, for programs to read: candidates in order with the vertices of
// their paths, rejected goals with reasons. A value that is not finite is null.
std::string PlanToJson(const Plan& plan, std::size_t tree_edges);

}  // namespace plumescout::lab
