// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/robot_rates.h"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "absl/strings/str_cat.h"
#include "server/base/errors.h"

namespace plumescout::server {
namespace {

// A correction has the field made anew and the map rebuilt.
constexpr double kScansOfCorrection = 20.0;
constexpr absl::Duration kPlanBurst = absl::Seconds(5);
// Beyond so many robots, those that have not called for long are forgotten.
constexpr std::size_t kMaxRemembered = 256;

TokenBucket MakeBucket(double per_s, absl::Duration burst) {
  return TokenBucket(per_s, std::max(1.0, per_s * absl::ToDoubleSeconds(burst)));
}

}  // namespace

RateLoad RateLoadOf(const std::vector<IncomingObservation>& batch, std::size_t bytes) {
  RateLoad load{.bytes = static_cast<double>(bytes)};
  for (const IncomingObservation& incoming : batch) {
    if (std::holds_alternative<Scan>(incoming.observation.payload)) load.scans += 1.0;
    if (std::holds_alternative<PoseCorrection>(incoming.observation.payload)) {
      load.scans += kScansOfCorrection;
    }
    if (std::holds_alternative<GasReading>(incoming.observation.payload)) load.gas_readings += 1.0;
  }
  return load;
}

RobotRates::RobotRates(const RateOptions& options, SteadyClock clock)
    : options_(options), clock_(std::move(clock)) {}

absl::Status RobotRates::AdmitBatch(const RobotId& robot, const RateLoad& load) {
  const SteadyTime now = clock_();
  absl::MutexLock lock(&mutex_);
  Buckets& buckets = Of(robot, now);
  const absl::Duration wait = WaitFor(buckets, load, now);
  if (wait > absl::ZeroDuration()) {
    return RateExceeded(absl::StrCat("robot \"", robot,
                                     "\" sends more than limits.max_scans_per_s,"
                                     " max_gas_readings_per_s and max_ingest_bytes_per_s allow"),
                        wait);
  }
  Take(buckets, load, now);
  return absl::OkStatus();
}

absl::Status RobotRates::AdmitPlan(const RobotId& robot) {
  const SteadyTime now = clock_();
  absl::MutexLock lock(&mutex_);
  TokenBucket& plans = Of(robot, now).plans;
  const absl::Duration wait = plans.WaitFor(1.0, now);
  if (wait > absl::ZeroDuration()) {
    return RateExceeded(absl::StrCat("robot \"", robot, "\" asks for more plans than ",
                                     "limits.max_plans_per_s = ", options_.plans_per_s),
                        wait);
  }
  plans.Take(1.0, now);
  return absl::OkStatus();
}

absl::Duration RobotRates::CountBatch(const RobotId& robot, const RateLoad& load) {
  const SteadyTime now = clock_();
  absl::MutexLock lock(&mutex_);
  Buckets& buckets = Of(robot, now);
  Take(buckets, load, now);
  return WaitFor(buckets, {}, now);
}

RobotRates::Buckets& RobotRates::Of(const RobotId& robot, SteadyTime now) {
  const auto found = buckets_.find(robot);
  if (found != buckets_.end()) return found->second;
  if (buckets_.size() >= kMaxRemembered) {
    std::erase_if(buckets_, [now](const auto& entry) {
      const Buckets& b = entry.second;
      return b.scans.is_full(now) && b.gas_readings.is_full(now) && b.bytes.is_full(now) &&
             b.plans.is_full(now);
    });
  }
  const Buckets full{MakeBucket(options_.scans_per_s, options_.ingest_burst),
                     MakeBucket(options_.gas_readings_per_s, options_.ingest_burst),
                     MakeBucket(options_.ingest_bytes_per_s, options_.ingest_burst),
                     MakeBucket(options_.plans_per_s, kPlanBurst)};
  return buckets_.emplace(robot, full).first->second;
}

absl::Duration RobotRates::WaitFor(Buckets& buckets, const RateLoad& load, SteadyTime now) {
  return std::max({buckets.scans.WaitFor(load.scans, now),
                   buckets.gas_readings.WaitFor(load.gas_readings, now),
                   buckets.bytes.WaitFor(load.bytes, now)});
}

void RobotRates::Take(Buckets& buckets, const RateLoad& load, SteadyTime now) {
  buckets.scans.Take(load.scans, now);
  buckets.gas_readings.Take(load.gas_readings, now);
  buckets.bytes.Take(load.bytes, now);
}

}  // namespace plumescout::server
