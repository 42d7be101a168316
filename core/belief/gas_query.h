// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/belief/belief.h"
#include "core/types/gas_at_place.h"
#include "core/types/pose2.h"

namespace plumescout {

// In the order of `places`. `species`: the gas by its place among the mission's. Whether
// further gases are observed goes by observed_variance_ratio alone: a variance, if the options name
// one, is on the first one's scale. REQUIRES: places are finite, and there is such a gas. Cost:
// O(places), each with that of SampledCells::Nearest; with verdicts on the mission's objective,
// which is of the first gas, O(cells) beside.
std::vector<GasAtPlace> QueryGas(const Belief& belief, const std::vector<Point2>& places,
                                 std::size_t species = 0, bool with_verdicts = false);

}  // namespace plumescout
