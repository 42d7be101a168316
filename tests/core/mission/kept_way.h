// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/mission/way_history.h"
#include "gtest/gtest.h"
#include "tests/support/box_room.h"

namespace plumescout::support {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

// What is kept of robot "a", which drives along y = 1.5 m in a room of 6 m by 3 m.
class KeptWay : public ::testing::Test {
 protected:
  void Scan(double x_m, std::int64_t time_ns, bool quarantined = false) {
    const Pose2 pose{x_m, 1.5, 0.0};
    history_.AddScan("a", time_ns, pose, ScanInBox(pose, 6, 3), {}, quarantined);
  }
  void Read(double x_m, std::int64_t time_ns, bool quarantined = false) {
    history_.AddReading("a", time_ns, {x_m, 1.5, 0.0}, {2.0, 0.0}, quarantined);
  }
  // Of the first gas.
  ReadingStore Readings() const { return history_.Readings(history_.HeardReadings()).front(); }
  std::vector<Point2> Places() const {
    std::vector<Point2> places;
    for (const WayHistory::Heard& heard : history_.HeardReadings()) places.push_back(heard.place);
    return places;
  }

  WayHistory history_{MissionOptions()};
};

}  // namespace plumescout::support
