// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/error_reason.h"

#include <algorithm>

#include "absl/strings/ascii.h"

namespace plumescout::client {

absl::string_view ErrorReason(const absl::Status& status) {
  const absl::string_view message = status.message();
  const absl::string_view word = message.substr(0, message.find(':'));
  const bool is_reason = !word.empty() && absl::ascii_isupper(word.front()) &&
                         std::all_of(word.begin(), word.end(), [](char c) {
                           return absl::ascii_isupper(c) || absl::ascii_isdigit(c) || c == '_';
                         });
  return is_reason ? word : absl::string_view();
}

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

}  // namespace plumescout::client
