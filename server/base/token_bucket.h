// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>

#include "absl/time/time.h"
#include "server/base/clock.h"

namespace plumescout::server {

// So much a second on average, and a burst of so much at once. An amount above the burst passes
// when the bucket is full, and is paid off afterwards. Thread-compatible.
class TokenBucket {
 public:
  // `per_s` 0: any amount passes. A new bucket is full.
  TokenBucket(double per_s, double burst) : per_s_(per_s), burst_(burst), level_(burst) {}

  // How long until `amount` may pass; zero if it may now. Times never go back.
  absl::Duration WaitFor(double amount, SteadyTime now) {
    Fill(now);
    const double missing = std::min(amount, burst_) - level_;
    if (per_s_ <= 0.0 || missing <= 0.0) return absl::ZeroDuration();
    return absl::Seconds(missing / per_s_);
  }
  // Lets it pass, whether it may or not.
  void Take(double amount, SteadyTime now) {
    Fill(now);
    if (per_s_ > 0.0) level_ -= amount;
  }
  bool is_full(SteadyTime now) const { return LevelAt(now) >= burst_; }

 private:
  double LevelAt(SteadyTime now) const {
    if (last_ == SteadyTime() || now <= last_) return level_;
    const double elapsed_s = std::chrono::duration<double>(now - last_).count();
    return std::min(burst_, level_ + per_s_ * elapsed_s);
  }
  void Fill(SteadyTime now) {
    level_ = LevelAt(now);
    last_ = std::max(last_, now);
  }

  double per_s_;
  double burst_;
  double level_;  // below 0: owed
  SteadyTime last_;
};

}  // namespace plumescout::server
