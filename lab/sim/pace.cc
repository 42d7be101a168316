// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/pace.h"

#include <algorithm>

#include "core/types/checker.h"

namespace plumescout::lab {
namespace {

constexpr double kMostSpeed_mps = 100.0;
constexpr double kMostLate_s = 60.0;
// Of the moves that a late leg asks for, until it is as late as it is to be.
constexpr double kHeldShare = 0.3;
// The top speed is kept over so long: moves come in ticks.
constexpr double kSpeedWindow_s = 0.25;
constexpr double kReadyRounding_s = 1e-6;

}  // namespace

absl::Status Validate(const PaceOptions& options) {
  return Checker()
      .InRangeAbove("pace.top_speed_mps", options.top_speed_mps.value_or(kMostSpeed_mps), 0.0,
                    kMostSpeed_mps)
      .InRange("pace.most_late_s", options.most_late_s, 0.0, kMostLate_s)
      .status();
}

Pace::Pace(const PaceOptions& options, std::uint64_t seed) : options_(options), rng_(seed) {
  BeginLeg();
}

void Pace::BeginLeg() {
  held_s_ = 0.0;
  late_s_ = options_.most_late_s > 0.0 ? rng_.Uniform(0.0, options_.most_late_s) : 0.0;
}

bool Pace::MayMove(double move_m, double now_s) {
  const double gone_s = now_s - asked_s_;
  asked_s_ = now_s;
  if (!(move_m > 0.0)) return true;
  const bool is_late_enough = held_s_ + gone_s > late_s_;
  if (late_s_ > 0.0 && !is_late_enough && rng_.Uniform01() < kHeldShare) {
    held_s_ += gone_s;
    return false;
  }
  if (!options_.top_speed_mps) return true;
  if (now_s < ready_s_ - kReadyRounding_s) return false;
  ready_s_ = std::max(ready_s_, now_s - kSpeedWindow_s) + move_m / *options_.top_speed_mps;
  return true;
}

}  // namespace plumescout::lab
