// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/notice_reader.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace plumescout::client {

void NoticeReader::Poll(const RobotSession& session, absl::Time now) {
  if (!is_served_) return;
  if (watch_ != nullptr && lease_token_ != session.lease_token) watch_ = nullptr;
  if (watch_ == nullptr) {
    if (now < open_at_) return;
    Open(session, now);
  }
  while (watch_ != nullptr) {
    absl::StatusOr<RobotNotice> notice = watch_->TryRead();
    if (absl::IsDeadlineExceeded(notice.status())) return;
    if (!notice.ok()) return Break(notice.status(), now);
    backoff_.Reset();
    Take(*std::move(notice));
  }
}

void NoticeReader::Open(const RobotSession& session, absl::Time now) {
  // What still holds is told again. Numbers of plans may have begun anew.
  invalidated_.reset();
  assigned_ = 0;
  absl::StatusOr<std::unique_ptr<RobotWatch>> watch = client_.WatchRobot(session);
  if (!watch.ok()) return Break(watch.status(), now);
  watch_ = *std::move(watch);
  lease_token_ = session.lease_token;
}

void NoticeReader::Take(RobotNotice notice) {
  if (const auto* standing = std::get_if<RobotStanding>(&notice)) Take(*standing);
  if (auto* invalidated = std::get_if<PlanInvalidated>(&notice)) {
    invalidated_ = std::move(*invalidated);
  }
  if (const auto* assigned = std::get_if<PlanAssigned>(&notice)) {
    assigned_ = std::max(assigned_, assigned->plan);
  }
}

void NoticeReader::Take(const RobotStanding& standing) {
  standing_ = standing;
  const bool is_news = standing.frame_suspect != place_doubted_;
  place_doubted_ = standing.frame_suspect;
  if (is_news && observer_ != nullptr) observer_->OnPlaceDoubted(place_doubted_);
}

void NoticeReader::Break(const absl::Status& why, absl::Time now) {
  is_served_ = !absl::IsUnimplemented(why);
  watch_ = nullptr;
  standing_ = {};
  open_at_ = now + backoff_.Next();
}

}  // namespace plumescout::client
