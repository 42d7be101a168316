// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/report/image.h"
#include "lab/report/plan_panels.h"

namespace plumescout::lab {

// One picture of a planning step: the panels side by side, below them tables of the candidates with
// the terms of their price and of the rejected goals with the reasons.
Image DrawPlanSheet(const PlanPicture& picture);

}  // namespace plumescout::lab
