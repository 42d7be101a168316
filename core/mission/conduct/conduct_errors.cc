// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/conduct_errors.h"

#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"

namespace plumescout {
namespace {

constexpr std::int64_t kCreditRetry_ns = 250'000'000;  // acknowledgements come far more often

}  // namespace

absl::Status MissionNotFound(const MissionId& mission) {
  return TypedError(absl::StatusCode::kNotFound, reason::kMissionNotFound,
                    absl::StrCat("missions/", mission));
}

absl::Status MissionExists(const MissionId& mission) {
  return TypedError(absl::StatusCode::kAlreadyExists, reason::kMissionExists,
                    absl::StrCat("missions/", mission));
}

absl::Status MissionPaused(const MissionId& mission) {
  return TypedError(absl::StatusCode::kFailedPrecondition, reason::kMissionPaused,
                    absl::StrCat("missions/", mission, " plans nothing until it is resumed"));
}

absl::Status MissionFinished(const MissionId& mission) {
  return TypedError(absl::StatusCode::kFailedPrecondition, reason::kMissionFinished,
                    absl::StrCat("missions/", mission, " can only be read"));
}

absl::Status RobotNotFound(const RobotId& robot) {
  return TypedError(absl::StatusCode::kNotFound, reason::kRobotNotFound,
                    absl::StrCat("robot \"", robot, "\""));
}

absl::Status LeaseHeld(const RobotId& robot, std::int64_t free_in_ns) {
  return WithRetryAfter(TypedError(absl::StatusCode::kFailedPrecondition, reason::kLeaseHeld,
                                   absl::StrCat("another client writes the log of robot \"", robot,
                                                "\"; set take_over to supersede it")),
                        free_in_ns);
}

absl::Status LeaseSuperseded(const RobotId& robot) {
  return TypedError(absl::StatusCode::kFailedPrecondition, reason::kLeaseSuperseded,
                    absl::StrCat("a newer registration writes the log of robot \"", robot, "\""));
}

absl::Status StreamReplaced(const RobotId& robot) {
  return TypedError(absl::StatusCode::kAborted, reason::kStreamReplaced,
                    absl::StrCat("a newer stream took over the log of robot \"", robot, "\""));
}

absl::Status CreditExceeded(std::int64_t sequence, std::int64_t credit_sequence) {
  return WithRetryAfter(
      TypedError(absl::StatusCode::kResourceExhausted, reason::kCreditExceeded,
                 absl::StrCat("sequence ", sequence, " is beyond the credit, ", credit_sequence)),
      kCreditRetry_ns);
}

}  // namespace plumescout
