// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"

namespace plumescout::client {

// A robot's clock between two looks at it, carried on by a clock of this machine that nobody sets.
// It is never ahead of the robot's, but late by what a look took to come here. Thread-safe.
class RunningClock {
 public:
  using Ticks = std::function<absl::Duration()>;  // since any moment

  explicit RunningClock(Ticks ticks = SteadyTicks) : ticks_(std::move(ticks)) {}

  void Note(std::int64_t now_ns) {
    absl::MutexLock lock(&mutex_);
    if (now_ns == noted_ns_) return;  // no news: it goes on
    noted_ns_ = now_ns;
    noted_at_ = ticks_();
  }
  // 0 before the first Note.
  std::int64_t Now_ns() const {
    absl::MutexLock lock(&mutex_);
    if (noted_ns_ == 0) return 0;
    return noted_ns_ + absl::ToInt64Nanoseconds(ticks_() - noted_at_);
  }

 private:
  static absl::Duration SteadyTicks() {
    return absl::FromChrono(std::chrono::steady_clock::now().time_since_epoch());
  }

  const Ticks ticks_;
  mutable absl::Mutex mutex_;
  std::int64_t noted_ns_ ABSL_GUARDED_BY(mutex_) = 0;
  absl::Duration noted_at_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::client
