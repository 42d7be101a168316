// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/error_reason.h"

#include <algorithm>
#include <string>

#include "absl/strings/ascii.h"
#include "absl/strings/cord.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"

namespace plumescout {
namespace {

constexpr char kRetryAfterPayload[] = "plumescout/retry_after_ns";

}  // namespace

absl::Status TypedError(absl::StatusCode code, absl::string_view reason,
                        absl::string_view message) {
  return {code, absl::StrCat(reason, ": ", message)};
}

absl::string_view ErrorReason(const absl::Status& status) {
  const absl::string_view message = status.message();
  const absl::string_view word = message.substr(0, message.find(':'));
  const bool is_reason = !word.empty() && absl::ascii_isupper(word.front()) &&
                         std::all_of(word.begin(), word.end(), [](char c) {
                           return absl::ascii_isupper(c) || absl::ascii_isdigit(c) || c == '_';
                         });
  return is_reason ? word : absl::string_view();
}

absl::Status WithRetryAfter(absl::Status status, std::int64_t delay_ns) {
  status.SetPayload(kRetryAfterPayload, absl::Cord(absl::StrCat(delay_ns)));
  return status;
}

std::optional<std::int64_t> RetryAfter_ns(const absl::Status& status) {
  const auto payload = status.GetPayload(kRetryAfterPayload);
  std::int64_t delay_ns = 0;
  if (!payload.has_value() || !absl::SimpleAtoi(std::string(*payload), &delay_ns)) {
    return std::nullopt;
  }
  return delay_ns;
}

absl::Status WithoutRetryAfter(absl::Status status) {
  status.ErasePayload(kRetryAfterPayload);
  return status;
}

}  // namespace plumescout
