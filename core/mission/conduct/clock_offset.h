// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdlib>

namespace plumescout {

// How far a robot's clock is to be taken to be off from now on: what was estimated, unless that is
// as good as what is in force. The tolerance is far more than the shortest delay of a link varies
// by, and far less than samples of the gas field differ by in age.
inline std::int64_t SettledOffset_ns(std::int64_t estimate_ns, std::int64_t in_force_ns) {
  constexpr std::int64_t kTolerance_ns = 20'000'000;
  return std::abs(estimate_ns - in_force_ns) <= kTolerance_ns ? in_force_ns : estimate_ns;
}

}  // namespace plumescout
