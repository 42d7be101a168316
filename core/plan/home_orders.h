// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/belief/belief.h"
#include "core/types/plan_request.h"

namespace plumescout {

// The request, for home if its robot is sent there.
PlanRequest WithOrders(const Belief& belief, PlanRequest request);

// A sentence that says so, with a space before it; empty for who is not sent home.
std::string WhySentHome(const Belief& belief, const RobotId& robot);

// A sentence that says why the mission is over (IsOver), with a space before it; empty if it is
// not.
std::string WhyOver(const Belief& belief);

}  // namespace plumescout
