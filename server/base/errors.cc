// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/errors.h"

#include <cstdint>
#include <map>
#include <string>

#include "absl/strings/cord.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "core/types/error_reason.h"
#include "proto/convert/status.h"

namespace plumescout::server {
namespace {

constexpr absl::string_view kAwaitedPayload = "plumescout/awaited";
constexpr std::int64_t kOverloadRetry_ns = 250'000'000;
constexpr std::int64_t kDrainRetry_ns = 1'000'000'000;  // about the time of a restart
constexpr std::int64_t kStoreRetry_ns = 1'000'000'000;
constexpr std::int64_t kRecoveryRetry_ns = 500'000'000;
constexpr std::int64_t kUnreachedRetry_ns = 1'000'000'000;

// A number that stands behind the reason and a word that names it.
struct Fact {
  absl::string_view reason;
  absl::string_view name;
};
constexpr Fact kFacts[] = {{reason::kSequenceGap, "expected"},
                           {reason::kStoreRolledBack, "applied_sequence"}};

std::map<std::string, std::string> Facts(const absl::string_view message) {
  for (const Fact& fact : kFacts) {
    absl::string_view rest = message;
    std::int64_t value = 0;
    if (absl::ConsumePrefix(&rest, absl::StrCat(fact.reason, ": ", fact.name, " ")) &&
        absl::SimpleAtoi(rest.substr(0, rest.find(',')), &value)) {
      return {{std::string(fact.name), absl::StrCat(value)}};
    }
  }
  return {};
}

absl::Status WithRetryInfo(const absl::Status& status) {
  const auto delay_ns = RetryAfter_ns(status);
  if (!delay_ns.has_value()) return status;
  return WithRetryDelay(WithoutRetryAfter(status), absl::Nanoseconds(*delay_ns));
}

}  // namespace

absl::Status Overloaded(absl::string_view what) {
  return WithRetryAfter(TypedError(absl::StatusCode::kResourceExhausted, reason::kOverloaded, what),
                        kOverloadRetry_ns);
}

absl::Status LimitReached(absl::string_view message) {
  return TypedError(absl::StatusCode::kResourceExhausted, reason::kLimitReached, message);
}

absl::Status RateExceeded(absl::string_view what, absl::Duration wait) {
  return WithRetryAfter(
      TypedError(absl::StatusCode::kResourceExhausted, reason::kRateExceeded, what),
      absl::ToInt64Nanoseconds(wait));
}

absl::Status GivenUp() { return absl::CancelledError("the caller gave up"); }

absl::Status Draining() {
  return WithRetryAfter(
      TypedError(absl::StatusCode::kUnavailable, reason::kDraining, "the server is going down"),
      kDrainRetry_ns);
}

absl::Status StoreTakesNothing(absl::string_view why) {
  absl::ConsumePrefix(&why, absl::StrCat(reason::kStoreUnavailable, ": "));
  return WithRetryAfter(TypedError(absl::StatusCode::kUnavailable, reason::kStoreUnavailable, why),
                        kStoreRetry_ns);
}

absl::Status StoreRolledBack(std::int64_t applied_sequence, std::int64_t told_sequence) {
  return TypedError(absl::StatusCode::kFailedPrecondition, reason::kStoreRolledBack,
                    absl::StrCat("applied_sequence ", applied_sequence, ", though ", told_sequence,
                                 " was durable: the server's data is an older copy"));
}

absl::Status MissionDamaged(absl::string_view mission, absl::string_view why) {
  return TypedError(absl::StatusCode::kDataLoss, reason::kStoreDamaged,
                    absl::StrCat("missions/", mission, ": ", why));
}

absl::Status Recovering(absl::string_view mission) {
  return WithRetryAfter(TypedError(absl::StatusCode::kUnavailable, reason::kRecovering,
                                   absl::StrCat("missions/", mission, " is read from the disk")),
                        kRecoveryRetry_ns);
}

absl::Status NodeUnreached(absl::string_view mission, absl::string_view node) {
  return WithRetryAfter(
      TypedError(absl::StatusCode::kUnavailable, reason::kNodeUnreached,
                 absl::StrCat("missions/", mission, " is served by node ", node,
                              ", where this call did not get; another one is to take it over")),
      kUnreachedRetry_ns);
}

absl::Status NameOfSeveral(absl::string_view mission) {
  return absl::FailedPreconditionError(
      absl::StrCat("missions/", mission, " is the name of several tenants' missions"));
}

absl::Status WithAwaitedMission(absl::Status status, absl::string_view key) {
  if (ErrorReason(status) == reason::kRecovering) {
    status.SetPayload(kAwaitedPayload, absl::Cord(key));
  }
  return status;
}

std::string AwaitedMission(const absl::Status& status) {
  return std::string(status.GetPayload(kAwaitedPayload).value_or(absl::Cord()));
}

absl::Status WithErrorInfo(const absl::Status& status) {
  if (status.ok()) return status;
  absl::Status typed = WithRetryInfo(status);
  typed.ErasePayload(kAwaitedPayload);
  if (!Reason(typed).empty()) return typed;
  const absl::string_view reason = ErrorReason(status);
  if (!reason.empty()) return WithReason(typed, reason, Facts(status.message()));
  return WithReason(typed, absl::StatusCodeToString(status.code()));
}

}  // namespace plumescout::server
