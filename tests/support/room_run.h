// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/types/observation.h"
#include "core/types/options.h"
#include "tests/support/box_room.h"

namespace plumescout::support {

// A robot's log while it circles in a room of 3 m x 3 m for 20 s: scans at 10 Hz, a gas reading
// after every third.
inline std::vector<Observation> RoomRun() {
  constexpr int kScans = 200;
  constexpr int kScansPerReading = 3;
  constexpr std::int64_t kScanPeriod_ns = 100'000'000;
  std::vector<Observation> log;
  for (int i = 0; i < kScans; ++i) {
    const std::int64_t time_ns = (i + 1) * kScanPeriod_ns;
    const double turn_rad = 0.05 * i;
    const Pose2 pose{1.5 + std::cos(turn_rad), 1.5 + std::sin(turn_rad), turn_rad};
    const auto add = [&](auto payload) {
      log.push_back({static_cast<std::int64_t>(log.size()) + 1, time_ns, pose, payload});
    };
    add(ScanInBox(pose, 3.0, 3.0));
    if (i % kScansPerReading == 0) add(GasReading{10.0 * pose.x_m, 0.0});
  }
  return log;
}

// Of a mission in which readings age so fast that epochs follow each other during a RoomRun, and
// not so fast that each refresh has to age them.
inline MissionOptions FastAgeing() {
  MissionOptions options;
  options.gas.ageing_half_life_s = 60.0;
  return options;
}

}  // namespace plumescout::support
