// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store_usage.h"

#include "absl/time/time.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kLookPeriod = absl::Minutes(1);

}  // namespace

std::map<std::string, std::int64_t> StoreUsage::BytesByMission() {
  absl::MutexLock lock(&mutex_);
  const SteadyTime now = clock_();
  if (now < look_at_) return bytes_;
  look_at_ = After(now, kLookPeriod);
  const auto missions = store_->List();
  if (!missions.ok()) return bytes_;
  bytes_.clear();
  for (const StoredMission& mission : *missions) bytes_[mission.key] = mission.bytes;
  return bytes_;
}

}  // namespace plumescout::server
