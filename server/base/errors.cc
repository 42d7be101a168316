// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/errors.h"

#include <algorithm>
#include <map>
#include <string>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "proto/convert/status.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kOverloadRetry = absl::Milliseconds(250);
constexpr absl::Duration kDrainRetry = absl::Seconds(1);  // about the time of a restart
constexpr char kSequenceGapPrefix[] = "SEQUENCE_GAP: expected ";

// The word before the first colon, if it is UPPER_SNAKE.
absl::string_view LeadingReason(absl::string_view message) {
  const std::size_t colon = message.find(':');
  if (colon == absl::string_view::npos || colon == 0) return {};
  const absl::string_view word = message.substr(0, colon);
  const bool upper = std::all_of(word.begin(), word.end(), [](char c) {
    return absl::ascii_isupper(c) || absl::ascii_isdigit(c) || c == '_';
  });
  return upper ? word : absl::string_view();
}

std::map<std::string, std::string> Facts(absl::string_view message) {
  if (!absl::ConsumePrefix(&message, kSequenceGapPrefix)) return {};
  std::int64_t expected = 0;
  if (!absl::SimpleAtoi(message.substr(0, message.find(',')), &expected)) return {};
  return {{"expected", absl::StrCat(expected)}};
}

}  // namespace

absl::Status MissionNotFound(const MissionId& mission) {
  return absl::NotFoundError(absl::StrCat("MISSION_NOT_FOUND: missions/", mission));
}

absl::Status RobotNotFound(const RobotId& robot) {
  return absl::NotFoundError(absl::StrCat("ROBOT_NOT_FOUND: robot \"", robot, "\""));
}

absl::Status LeaseHeld(const RobotId& robot, absl::Duration free_in) {
  const absl::Status status = absl::FailedPreconditionError(
      absl::StrCat("LEASE_HELD: another client writes the log of robot \"", robot,
                   "\"; set take_over to supersede it"));
  return WithRetryDelay(status, free_in);
}

absl::Status LeaseSuperseded(const RobotId& robot) {
  return absl::FailedPreconditionError(absl::StrCat(
      "LEASE_SUPERSEDED: a newer registration writes the log of robot \"", robot, "\""));
}

absl::Status StreamReplaced(const RobotId& robot) {
  return absl::AbortedError(
      absl::StrCat("STREAM_REPLACED: a newer stream took over the log of robot \"", robot, "\""));
}

absl::Status CreditExceeded(std::int64_t sequence, std::int64_t credit_sequence) {
  return WithRetryDelay(
      absl::ResourceExhaustedError(absl::StrCat("CREDIT_EXCEEDED: sequence ", sequence,
                                                " is beyond the credit, ", credit_sequence)),
      kOverloadRetry);
}

absl::Status Overloaded(absl::string_view what) {
  return WithRetryDelay(absl::ResourceExhaustedError(absl::StrCat("OVERLOADED: ", what)),
                        kOverloadRetry);
}

absl::Status LimitReached(absl::string_view message) {
  return absl::ResourceExhaustedError(absl::StrCat("LIMIT_REACHED: ", message));
}

absl::Status Draining() {
  return WithRetryDelay(absl::UnavailableError("DRAINING: the server is going down"), kDrainRetry);
}

absl::Status WithErrorInfo(const absl::Status& status) {
  if (status.ok() || !Reason(status).empty()) return status;
  const absl::string_view reason = LeadingReason(status.message());
  if (!reason.empty()) return WithReason(status, reason, Facts(status.message()));
  return WithReason(status, absl::StatusCodeToString(status.code()));
}

}  // namespace plumescout::server
