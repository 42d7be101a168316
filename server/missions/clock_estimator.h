// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace plumescout::server {

// How far our clock is ahead of a robot's, from when its batches were sent by its clock and arrived
// by ours. What lies between is the offset and the delay of the link, which is never negative: the
// least of some time is the offset, and the shortest delay. Jitter, and a backlog that is sent
// late, only make others greater.
//
// The least is of the last 35 to 40 s: a clock that drifts by 100 ppm is 4 ms off by then. A clock
// that was set is followed at once if it is plain: its sent times go back, or a batch arrives
// earlier than any delay explains. Otherwise, when all batches of some time come later by more than
// links differ.
//
// Of a batch that lay on the wire because nobody read it, that time is in the difference, too. If
// such a batch begins an estimate, the estimate is provisional, and the next ones may lower it by
// any amount. While all batches are such, spans stay as they are: a drift is then followed only as
// far as it makes the offset less. Costs O(1) memory and time. Thread-compatible.
class ClockEstimator {
 public:
  // Delays vary by less, and so do clocks that nobody sets.
  static constexpr std::int64_t kStep_ns = 1'000'000'000;

  // Takes note of a batch; arrivals come in order, or nearly so. `at_the_latest`: it arrived then,
  // or any time before, since nobody looked; such a batch makes the offset greater only if the
  // clock was set back, which its sent time shows. Returns the estimate.
  std::int64_t Note(std::int64_t sent_ns, std::int64_t arrived_ns, bool at_the_latest = false);

  // The last batch lowered an estimate that was provisional: no clock was set.
  bool lowered_itself() const { return lowered_itself_; }

 private:
  // The least of a span of time.
  struct Bucket {
    std::int64_t span = 0;
    std::int64_t least_ns = 0;
  };
  // Batches that all came too late for the estimate.
  struct Late {
    std::int64_t since_ns = 0;
    std::int64_t least_ns = 0;
  };

  bool WasSet(std::int64_t sent_ns, std::int64_t difference_ns, std::int64_t arrived_ns);
  std::int64_t Least_ns() const;

  std::deque<Bucket> buckets_;  // the newest last
  std::optional<Late> late_;
  std::int64_t last_sent_ns_ = 0;
  bool is_provisional_ = false;  // begun by a batch that nobody saw arrive, and none since
  bool lowered_itself_ = false;
};

}  // namespace plumescout::server
