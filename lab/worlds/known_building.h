// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/statusor.h"
#include "lab/worlds/random_world.h"

namespace plumescout::lab {

// A building (MakeBuilding) of which all is known, made up from a seed: one robot, `goal_count`
// places that it can reach, and the gas posterior of readings taken all over it of three plumes, so
// that belief.gas_what_if is there. For how planners scale: `width_cells` x `height_cells` of 0.1
// m.
absl::StatusOr<RandomWorld> MakeKnownBuilding(int width_cells, int height_cells, std::uint64_t seed,
                                              int goal_count);

}  // namespace plumescout::lab
