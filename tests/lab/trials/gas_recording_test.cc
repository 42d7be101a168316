// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/gas_recording.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/lab/sim/small_scene.h"

namespace plumescout::lab {
namespace gas_recording_test {

TEST(GasRecordingTest, KeepsWaysAndReadingsAsTheMissionHeardThem) {
  MissionOptions mission;
  mission.planning.strategy = "plumescout";
  const auto recording = RecordGas(SmallWorld(), mission, 1, 10.0);
  ASSERT_TRUE(recording.ok()) << recording.status();
  const auto& heard = recording->heard;
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end(),
                             [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; }));
  const auto readings = std::count_if(heard.begin(), heard.end(),
                                      [](const auto& h) { return h.reading.has_value(); });
  EXPECT_GE(readings, 5);
  EXPECT_GT(static_cast<std::ptrdiff_t>(heard.size()), 3 * readings) << "scans come more often";
  EXPECT_GT(std::count(recording->states.values().begin(), recording->states.values().end(),
                       CellState::kFree),
            100);
  EXPECT_EQ(recording->response_time_s, 0.5);
}

}  // namespace gas_recording_test
}  // namespace plumescout::lab
