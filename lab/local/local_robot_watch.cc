// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/local/local_robot_watch.h"

#include "absl/time/clock.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {

absl::StatusOr<RobotNotice> LocalRobotWatch::Read(absl::Duration timeout) {
  const absl::Time deadline = absl::Now() + timeout;
  while (!cancelled_) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const RobotNews news, mission_->NewsOf(robot_, lease_token_));
    if (auto notice = FirstOf(news)) return *std::move(notice);
    if (!mission_->AwaitChange(news.revision, deadline, cancelled_)) break;
  }
  if (cancelled_) return absl::CancelledError("the watch was cancelled");
  return absl::DeadlineExceededError("no notice yet");
}

void LocalRobotWatch::Cancel() {
  cancelled_ = true;
  mission_->Wake();
}

std::optional<RobotNotice> LocalRobotWatch::FirstOf(const RobotNews& news) {
  if (told_.standing != news.standing) {
    told_.standing = news.standing;
    return *news.standing;
  }
  if (told_.invalidated != news.invalidated) {
    told_.invalidated = news.invalidated;
    if (news.invalidated) return *news.invalidated;
  }
  if (told_.assigned != news.assigned) {
    told_.assigned = news.assigned;
    if (news.assigned) return *news.assigned;
  }
  return std::nullopt;
}

}  // namespace plumescout::lab
