// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/gas_reading.h"
#include "core/types/grid.h"
#include "core/types/pose2.h"
#include "core/types/rng.h"

namespace plumescout::testing {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

struct TimedReading {
  std::int64_t time_ns;
  Point2 position;
  GasReading reading;
};

// A second apart, anywhere on the map; of two thirds nobody says how noisy they are.
inline std::vector<TimedReading> RandomTimedReadings(const Grid<CellState>& states, int count,
                                                     Rng& rng) {
  const double width_m = states.width() * states.geometry().resolution_m;
  const double height_m = states.height() * states.geometry().resolution_m;
  std::vector<TimedReading> readings;
  for (int k = 0; k < count; ++k) {
    readings.push_back({k * kSecond_ns,
                        {rng.Uniform(0.0, width_m), rng.Uniform(0.0, height_m)},
                        {rng.Uniform(0.0, 40.0), k % 3 == 0 ? rng.Uniform(0.1, 2.0) : 0.0}});
  }
  return readings;
}

}  // namespace plumescout::testing
