// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/error_reason.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "absl/strings/numbers.h"
#include "proto/convert/status.h"

namespace plumescout::client {
namespace {

// A server that asks for more is tried all the same: it may have come back in another way.
constexpr absl::Duration kLongestRetryDelay = absl::Seconds(30);
constexpr char kAppliedSequence[] = "applied_sequence";  // in the metadata of the error

}  // namespace

bool IsRetriable(const absl::Status& status) {
  switch (status.code()) {
    case absl::StatusCode::kUnavailable:
    case absl::StatusCode::kDeadlineExceeded:
    case absl::StatusCode::kResourceExhausted:
    case absl::StatusCode::kAborted:
    case absl::StatusCode::kCancelled:
    case absl::StatusCode::kInternal:
    case absl::StatusCode::kUnknown:
      return true;
    default:
      return false;
  }
}

absl::Duration RetryDelayOf(const absl::Status& status) {
  std::optional<absl::Duration> delay = RetryDelay(status);
  if (!delay.has_value()) {
    if (const auto delay_ns = RetryAfter_ns(status)) delay = absl::Nanoseconds(*delay_ns);
  }
  return std::clamp(delay.value_or(absl::ZeroDuration()), absl::ZeroDuration(), kLongestRetryDelay);
}

std::int64_t RolledBackTo(const absl::Status& status) {
  const auto metadata = ReasonMetadata(status);
  const auto found = metadata.find(kAppliedSequence);
  std::int64_t applied_sequence = 0;
  if (found == metadata.end() || !absl::SimpleAtoi(found->second, &applied_sequence)) return 0;
  return std::max<std::int64_t>(applied_sequence, 0);
}

std::vector<std::string> RefusedFields(const absl::Status& status) {
  std::vector<std::string> fields;
  for (FieldViolation& violation : FieldViolations(status)) {
    fields.push_back(std::move(violation.field));
  }
  return fields;
}

}  // namespace plumescout::client
