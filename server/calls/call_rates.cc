// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/call_rates.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "server/base/errors.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kBurst = absl::Seconds(5);
// Where there is no place left, those that have not called for long are looked for this often.
constexpr absl::Duration kSweepPeriod = absl::Seconds(1);

TokenBucket MakeBucket(double per_s) {
  return TokenBucket(per_s, std::max(1.0, per_s * absl::ToDoubleSeconds(kBurst)));
}

}  // namespace

CallRates::Buckets CallRates::Full() const {
  return {MakeBucket(options_.calls_per_s), MakeBucket(options_.costly_calls_per_s)};
}

absl::Status CallRates::Admit(const std::string& account, Rpc rpc) {
  if (rpc == Rpc::kDrainServer) return absl::OkStatus();
  const bool is_costly = RowOf(rpc).is_costly;
  const SteadyTime now = clock_();
  absl::MutexLock lock(&mutex_);
  Buckets& buckets = Of(account, now);
  const absl::Duration call_wait = buckets.calls.WaitFor(1.0, now);
  if (call_wait > absl::ZeroDuration()) {
    return RateExceeded(
        absl::StrCat("more calls than limits.max_calls_per_s = ", options_.calls_per_s), call_wait);
  }
  const absl::Duration costly_wait =
      is_costly ? buckets.costly_calls.WaitFor(1.0, now) : absl::ZeroDuration();
  if (costly_wait > absl::ZeroDuration()) {
    return RateExceeded(absl::StrCat("more calls that cost much than limits.max_costly_calls_per_s",
                                     " = ", options_.costly_calls_per_s),
                        costly_wait);
  }
  buckets.calls.Take(1.0, now);
  if (is_costly) buckets.costly_calls.Take(1.0, now);
  return absl::OkStatus();
}

CallRates::Buckets& CallRates::Of(const std::string& account, SteadyTime now) {
  const auto found = buckets_.find(account);
  if (found != buckets_.end()) return found->second;
  if (buckets_.size() >= options_.max_callers && now >= next_sweep_) {
    next_sweep_ = After(now, kSweepPeriod);
    std::erase_if(buckets_, [now](const auto& entry) {
      return entry.second.calls.is_full(now) && entry.second.costly_calls.is_full(now);
    });
  }
  if (buckets_.size() >= options_.max_callers) return others_;
  return buckets_.emplace(account, Full()).first->second;
}

}  // namespace plumescout::server
