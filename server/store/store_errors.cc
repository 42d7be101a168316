// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/store_errors.h"

#include <string>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"

namespace plumescout::server {
namespace {

constexpr absl::string_view kReasonEnd = ": ";  // of TypedError
constexpr absl::string_view kElsewhere = "mission ";
constexpr absl::string_view kServedBy = " is served by node ";

std::string Name(absl::string_view key) { return absl::StrCat("mission ", absl::CHexEscape(key)); }

absl::Status Fenced(absl::string_view key, absl::string_view why) {
  return TypedError(absl::StatusCode::kFailedPrecondition, reason::kFenced,
                    absl::StrCat(Name(key), " ", why));
}

}  // namespace

absl::Status NotStored(absl::string_view key) {
  return TypedError(absl::StatusCode::kNotFound, reason::kMissionNotFound,
                    absl::StrCat(Name(key), " is not stored"));
}

absl::Status AlreadyStored(absl::string_view key) {
  return TypedError(absl::StatusCode::kAlreadyExists, reason::kMissionExists,
                    absl::StrCat(Name(key), " is stored already"));
}

absl::Status FencedByEpoch(absl::string_view key, std::int64_t epoch, std::int64_t newest) {
  return Fenced(key, absl::StrCat("is written under epoch ", newest, ", not ", epoch));
}

absl::Status MissionElsewhere(absl::string_view key, absl::string_view node) {
  return TypedError(absl::StatusCode::kUnavailable, reason::kMissionElsewhere,
                    absl::StrCat(kElsewhere, absl::Utf8SafeCHexEscape(key), kServedBy, node));
}

absl::string_view NodeElsewhere(const absl::Status& status) {
  if (ErrorReason(status) != reason::kMissionElsewhere) return {};
  const absl::string_view message = status.message();
  return message.substr(message.rfind(' ') + 1);
}

std::string KeyElsewhere(const absl::Status& status) {
  if (NodeElsewhere(status).empty()) return {};
  absl::string_view key = status.message().substr(0, status.message().rfind(kServedBy));
  key.remove_prefix(reason::kMissionElsewhere.size() + kReasonEnd.size() + kElsewhere.size());
  std::string unescaped;
  return absl::CUnescape(key, &unescaped) ? unescaped : std::string();
}

absl::Status FencedByNamesake(absl::string_view key) {
  return Fenced(key, "is another one of that name, or was not taken over");
}

absl::Status FencedByHead(absl::string_view key, std::int64_t first_number, std::int64_t head) {
  return Fenced(
      key, absl::StrCat("has record ", head, " last, so ", first_number, " is not the next one"));
}

absl::Status SnapshotAhead(absl::string_view key, std::int64_t revision, std::int64_t head) {
  return absl::InvalidArgumentError(absl::StrCat("snapshot of revision ", revision, ": ", Name(key),
                                                 " has record ", head, " last"));
}

absl::Status NotKept(absl::string_view key, std::int64_t last_gone) {
  return absl::OutOfRangeError(absl::StrCat("mission ", absl::CHexEscape(key),
                                            " keeps no events up to ", last_gone, " any more"));
}

absl::Status NotDamaged(absl::string_view key) {
  return absl::FailedPreconditionError(absl::StrCat(Name(key), " is not damaged"));
}

absl::Status BadFirstNumber(std::int64_t first_number) {
  return absl::InvalidArgumentError(absl::StrCat("first_number = ", first_number, " is not > 0"));
}

absl::Status StoreDamaged(absl::string_view what) {
  return TypedError(absl::StatusCode::kDataLoss, reason::kStoreDamaged, what);
}

absl::Status StoreUnavailable(absl::string_view what) {
  return TypedError(absl::StatusCode::kUnavailable, reason::kStoreUnavailable, what);
}

}  // namespace plumescout::server
