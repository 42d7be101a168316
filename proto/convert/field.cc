// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/field.h"

#include <algorithm>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/error_reason.h"
#include "google/rpc/error_details.pb.h"
#include "proto/convert/status.h"

namespace plumescout {
namespace {

constexpr std::size_t kMaxEchoedBytes = 80;  // of a refused string, before escaping

// `reason`: "WORD: " or nothing, which comes first in the message.
absl::Status Violation(absl::string_view field, absl::string_view description,
                       absl::string_view reason = "",
                       absl::StatusCode code = absl::StatusCode::kInvalidArgument) {
  google::rpc::BadRequest detail;
  auto* violation = detail.add_field_violations();
  violation->set_field(std::string(field));
  violation->set_description(std::string(description));
  absl::Status status(code, absl::StrCat(reason, field, " ", description));
  AttachDetail(detail, status);
  return status;
}

// The "REASON: " that a message may begin with.
absl::string_view LeadingReason(const absl::Status& status) {
  constexpr absl::string_view kEnd = ": ";
  const std::size_t end = ErrorReason(status).size();
  if (end == 0 || status.message().substr(end, kEnd.size()) != kEnd) return "";
  return status.message().substr(0, end + kEnd.size());
}

}  // namespace

absl::Status FieldError(absl::string_view field, absl::string_view value, absl::string_view rule) {
  return Violation(
      field, absl::StrCat("= \"", absl::CHexEscape(value.substr(0, kMaxEchoedBytes)), "\" ", rule));
}

absl::Status FieldError(absl::string_view field, double value, absl::string_view rule) {
  return Violation(field, absl::StrCat("= ", value, " ", rule));
}

absl::Status FieldError(absl::string_view field, absl::string_view rule) {
  return Violation(field, rule);
}

absl::Status NotYetError(absl::string_view field, std::int64_t value, absl::string_view rule) {
  return Violation(field, absl::StrCat("= ", value, " ", rule), "", absl::StatusCode::kOutOfRange);
}

absl::Status CheckFinite(absl::string_view field, double value) {
  return WithField(Checker().Finite(field, value).status(), "");
}

absl::Status CheckPositive(absl::string_view field, double value) {
  return WithField(Checker().Positive(field, value).status(), "");
}

absl::Status CheckNotNegative(absl::string_view field, double value) {
  return WithField(Checker().NotNegative(field, value).status(), "");
}

absl::Status CheckRange(absl::string_view field, double value, double low, double high) {
  return WithField(Checker().InRange(field, value, low, high).status(), "");
}

absl::Status CheckIntRange(absl::string_view field, std::int64_t value, std::int64_t low,
                           std::int64_t high) {
  return WithField(Checker().InRange(field, value, low, high).status(), "");
}

absl::Status CheckPresent(absl::string_view field, bool present) {
  return present ? absl::OkStatus() : FieldError(field, "must be set");
}

std::string Join(absl::string_view parent, absl::string_view name) {
  return parent.empty() ? std::string(name) : absl::StrCat(parent, ".", name);
}

std::string Join(absl::string_view parent, absl::string_view name, int index) {
  return absl::StrCat(Join(parent, name), "[", index, "]");
}

absl::Status WithField(const absl::Status& status, absl::string_view parent,
                       absl::Span<const FieldName> renamed) {
  if (!absl::IsInvalidArgument(status) || !FieldViolations(status).empty()) return status;
  const absl::string_view reason = LeadingReason(status);
  const absl::string_view message = status.message().substr(reason.size());
  const std::size_t name_end = message.find(' ');
  if (name_end == absl::string_view::npos) return Violation(parent, message, reason);
  absl::string_view name = message.substr(0, name_end);
  for (const FieldName& rename : renamed) {
    if (rename.core == name) {
      name = rename.wire;
      break;
    }
  }
  return Violation(Join(parent, name), message.substr(name_end + 1), reason);
}

}  // namespace plumescout
