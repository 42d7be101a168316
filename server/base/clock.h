// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "absl/time/clock.h"
#include "absl/time/time.h"

namespace plumescout::server {

// Monotonic time: leases and deadlines must not move when somebody sets the wall clock.
using SteadyTime = std::chrono::steady_clock::time_point;
using SteadyClock = std::function<SteadyTime()>;

inline SteadyTime SteadyNow() { return std::chrono::steady_clock::now(); }

// What the samples of robots are compared with, nanoseconds since the Unix epoch.
using WallClock = std::function<std::int64_t()>;
inline std::int64_t WallNow_ns() { return absl::GetCurrentTimeNanos(); }

// `from` + `duration`, saturating at SteadyTime::max().
inline SteadyTime After(SteadyTime from, absl::Duration duration) {
  if (from == SteadyTime::max() || duration >= absl::FromChrono(SteadyTime::max() - from)) {
    return SteadyTime::max();
  }
  return from + absl::ToChronoNanoseconds(duration);
}

// As core counts time: its zero is the clock's.
inline std::int64_t ToNanoseconds(SteadyTime time) {
  return absl::ToInt64Nanoseconds(absl::FromChrono(time.time_since_epoch()));
}

// The monotonic instant of a gRPC deadline; max() for none.
inline SteadyTime ToSteady(std::chrono::system_clock::time_point deadline) {
  if (deadline == std::chrono::system_clock::time_point::max()) return SteadyTime::max();
  const auto wall_now = std::chrono::system_clock::now();
  return After(SteadyNow(), absl::FromChrono(deadline - wall_now));
}

}  // namespace plumescout::server
