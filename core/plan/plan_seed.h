// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/types/ids.h"

namespace plumescout {

// The seed of a plan that names none: another for every mission, robot and plan of the robot. The
// same on every platform. Never 0.
std::uint64_t DerivedPlanSeed(std::uint64_t mission_seed, const RobotId& robot,
                              std::int64_t plans_issued);

}  // namespace plumescout
