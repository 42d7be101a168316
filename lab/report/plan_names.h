// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/plan.h"

namespace plumescout::lab {

// How people call them, in small letters.
const char* NameOf(MissionPhase phase);
const char* NameOf(GoalKind kind);
const char* NameOf(RejectionReason reason);
const char* NameOf(PlanEnd end);
const char* NameOf(PathSource source);

}  // namespace plumescout::lab
