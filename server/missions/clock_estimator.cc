// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/clock_estimator.h"

#include <algorithm>
#include <cstddef>

namespace plumescout::server {
namespace {

constexpr std::int64_t kSpan_ns = 5'000'000'000;
constexpr std::size_t kMostBuckets = 8;
// A link may be slow for a moment.
constexpr std::int64_t kPatience_ns = 3'000'000'000;

}  // namespace

std::int64_t ClockEstimator::Note(std::int64_t sent_ns, std::int64_t arrived_ns,
                                  bool at_the_latest) {
  const std::int64_t difference_ns = arrived_ns - sent_ns;
  lowered_itself_ = false;
  const bool tells_nothing = at_the_latest && !buckets_.empty() &&
                             sent_ns >= last_sent_ns_ - kStep_ns && difference_ns >= Least_ns();
  if (tells_nothing) {
    last_sent_ns_ = sent_ns;
    return Least_ns();
  }
  std::int64_t least_ns = difference_ns;
  if (buckets_.empty() || WasSet(sent_ns, difference_ns, arrived_ns)) {
    if (late_) least_ns = std::min(least_ns, late_->least_ns);
    late_.reset();
    buckets_.clear();
    is_provisional_ = at_the_latest;
  } else if (!at_the_latest && !late_) {
    is_provisional_ = false;
  }
  last_sent_ns_ = sent_ns;
  const std::int64_t span = arrived_ns / kSpan_ns;
  if (buckets_.empty() || buckets_.back().span < span) {
    buckets_.push_back({span, least_ns});
  }
  buckets_.back().least_ns = std::min(buckets_.back().least_ns, least_ns);
  // While all come late the last ones that did not still count.
  const bool may_forget = !late_.has_value();
  while (buckets_.size() > kMostBuckets ||
         (may_forget && span - buckets_.front().span >= static_cast<std::int64_t>(kMostBuckets))) {
    buckets_.pop_front();
  }
  return Least_ns();
}

bool ClockEstimator::WasSet(std::int64_t sent_ns, std::int64_t difference_ns,
                            std::int64_t arrived_ns) {
  const std::int64_t least_ns = Least_ns();
  const bool went_back = sent_ns < last_sent_ns_ - kStep_ns;
  const bool is_early = difference_ns < least_ns - kStep_ns;
  if (went_back || is_early) {
    late_.reset();
    lowered_itself_ = is_provisional_ && !went_back;
    return !lowered_itself_;
  }
  if (difference_ns <= least_ns + kStep_ns) {
    late_.reset();
    return false;
  }
  if (!late_) late_ = Late{arrived_ns, difference_ns};
  late_->least_ns = std::min(late_->least_ns, difference_ns);
  return arrived_ns - late_->since_ns >= kPatience_ns;
}

std::int64_t ClockEstimator::Least_ns() const {
  return std::min_element(buckets_.begin(), buckets_.end(),
                          [](const Bucket& a, const Bucket& b) { return a.least_ns < b.least_ns; })
      ->least_ns;
}

}  // namespace plumescout::server
