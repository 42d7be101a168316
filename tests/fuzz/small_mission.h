// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/types/options.h"

namespace plumescout::fuzz {

inline constexpr std::int64_t kSmallMissionCells = 16'384;  // four tiles

// Of a mission so small that one input takes milliseconds.
inline MissionOptions SmallMission() {
  MissionOptions options;
  options.occupancy.resolution_m = 0.5;
  options.occupancy.max_extent_m = 30.0;
  options.occupancy.max_cell_count = kSmallMissionCells;
  options.planning.sample_count = 50;
  return options;
}

}  // namespace plumescout::fuzz
