// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/errors.h"

#include <cstdint>
#include <map>
#include <string>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "core/types/error_reason.h"
#include "proto/convert/status.h"

namespace plumescout::server {
namespace {

constexpr std::int64_t kOverloadRetry_ns = 250'000'000;
constexpr std::int64_t kDrainRetry_ns = 1'000'000'000;  // about the time of a restart

std::map<std::string, std::string> Facts(absl::string_view message) {
  if (!absl::ConsumePrefix(&message, absl::StrCat(reason::kSequenceGap, ": expected "))) return {};
  std::int64_t expected = 0;
  if (!absl::SimpleAtoi(message.substr(0, message.find(',')), &expected)) return {};
  return {{"expected", absl::StrCat(expected)}};
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

absl::Status Draining() {
  return WithRetryAfter(
      TypedError(absl::StatusCode::kUnavailable, reason::kDraining, "the server is going down"),
      kDrainRetry_ns);
}

absl::Status WithErrorInfo(const absl::Status& status) {
  if (status.ok()) return status;
  absl::Status typed = WithRetryInfo(status);
  if (!Reason(typed).empty()) return typed;
  const absl::string_view reason = ErrorReason(status);
  if (!reason.empty()) return WithReason(typed, reason, Facts(status.message()));
  return WithReason(typed, absl::StatusCodeToString(status.code()));
}

}  // namespace plumescout::server
