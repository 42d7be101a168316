// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "absl/status/status.h"
#include "core/types/checker.h"

namespace plumescout::lab {

// A robot's clock that is off, and goes too fast or too slow.
struct ClockErrorOptions {
  double offset_s = 0.0;   // by which it is ahead of the world's when that begins, [-1e6, 1e6]
  double drift_ppm = 0.0;  // by which it gains on it, [-10000, 10000]

  friend bool operator==(const ClockErrorOptions&, const ClockErrorOptions&) = default;
};

// kInvalidArgument naming field, value and range.
inline absl::Status Validate(const ClockErrorOptions& options) {
  constexpr double kMostOffset_s = 1e6;
  constexpr double kMostDrift_ppm = 1e4;
  return Checker()
      .InRange("clock.offset_s", options.offset_s, -kMostOffset_s, kMostOffset_s)
      .InRange("clock.drift_ppm", options.drift_ppm, -kMostDrift_ppm, kMostDrift_ppm)
      .status();
}

// What the clock says when the world's, which began at `start_ns`, says `now_ns`; the same to the
// nanosecond if it is right.
inline std::int64_t ToldTime_ns(const ClockErrorOptions& options, std::int64_t start_ns,
                                std::int64_t now_ns) {
  constexpr double kNanosecondsPerSecond = 1e9;
  constexpr double kPerMillion = 1e-6;
  const auto gone_ns = static_cast<double>(now_ns - start_ns);
  return now_ns + std::llround(options.offset_s * kNanosecondsPerSecond +
                               options.drift_ppm * kPerMillion * gone_ns);
}

// What the world's clock says then; the other way round, to the nanosecond but for rounding.
inline std::int64_t WorldTime_ns(const ClockErrorOptions& options, std::int64_t start_ns,
                                 std::int64_t told_ns) {
  constexpr double kNanosecondsPerSecond = 1e9;
  constexpr double kPerMillion = 1e-6;
  const auto gone_ns =
      static_cast<double>(told_ns - start_ns) - options.offset_s * kNanosecondsPerSecond;
  return start_ns + std::llround(gone_ns / (1.0 + options.drift_ppm * kPerMillion));
}

}  // namespace plumescout::lab
