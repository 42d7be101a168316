// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "core/types/observation.h"

namespace plumescout::client {

// Tells of a robot what has changed, and at most every kPeriod_ns.
class StatusReports {
 public:
  static constexpr std::int64_t kPeriod_ns = 10'000'000'000;

  // What to tell at this time by the robot's clock, if anything. `news`: what it says now, if it
  // says anything new; what is not told at once is told later, unless it has changed again.
  std::optional<RobotStatus> Take(const std::optional<RobotStatus>& news, std::int64_t now_ns) {
    if (news) latest_ = news;
    const bool is_soon = told_ && now_ns >= told_ns_ && now_ns - told_ns_ < kPeriod_ns;
    if (latest_ == told_ || is_soon) return std::nullopt;
    told_ = latest_;
    told_ns_ = now_ns;
    return told_;
  }

 private:
  std::optional<RobotStatus> latest_;
  std::optional<RobotStatus> told_;
  std::int64_t told_ns_ = 0;
};

}  // namespace plumescout::client
