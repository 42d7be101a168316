// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/belief/belief.h"
#include "core/types/cell.h"
#include "core/types/map_snapshot.h"

namespace plumescout {

// The cells in which robots are, and those in which they began: from there ways are looked for.
std::vector<Cell> PlacesOfRobots(const Belief& belief);

// How much of what robots can reach from there is known of the first gas: of the cells where a
// robot may stand, those whose variance by the model counts as observed (ObservedVariance_ppm2).
// What lies behind frontiers is not known to be there, and is in neither. Cost: O(cells).
Completeness AssessCompleteness(const Belief& belief);

}  // namespace plumescout
