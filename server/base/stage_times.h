// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "absl/strings/string_view.h"
#include "absl/time/time.h"

namespace plumescout::server {

// What calls wait for: a belief that holds what they ask about, a thread of a pool, a search for a
// plan, the mission's writer to commit it, an answer to be made of a belief, the disk.
enum class Stage { kBelief, kQueue, kSearch, kCommit, kRead, kDurable };
inline constexpr std::array<absl::string_view, 6> kStageNames = {"belief", "queue", "search",
                                                                 "commit", "read",  "durable"};

// Where the time of one call went. Thread-safe.
class StageTimes {
 public:
  void Add(Stage stage, absl::Duration time) {
    times_ns_[static_cast<std::size_t>(stage)] += absl::ToInt64Nanoseconds(time);
  }
  absl::Duration Of(Stage stage) const {
    return absl::Nanoseconds(times_ns_[static_cast<std::size_t>(stage)].load());
  }

 private:
  std::array<std::atomic<std::int64_t>, kStageNames.size()> times_ns_ = {};
};

}  // namespace plumescout::server
