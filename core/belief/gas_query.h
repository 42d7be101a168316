// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/belief/belief.h"
#include "core/types/gas_at_place.h"
#include "core/types/pose2.h"

namespace plumescout {

// In the order of `places`. REQUIRES: they are finite. Cost: O(places).
std::vector<GasAtPlace> QueryGas(const Belief& belief, const std::vector<Point2>& places);

}  // namespace plumescout
