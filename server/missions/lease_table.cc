// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/lease_table.h"

#include <utility>

#include "core/mission/conduct/conduct_errors.h"
#include "core/types/status_macros.h"

namespace plumescout::server {

LeaseTable::LeaseTable(absl::Duration hold, std::int64_t first_token, SteadyClock clock)
    : clock_(std::move(clock)), book_(absl::ToInt64Nanoseconds(hold), first_token) {}

absl::StatusOr<std::int64_t> LeaseTable::Propose(const RobotId& robot, bool take_over) {
  absl::MutexLock lock(&mutex_);
  return book_.Propose(robot, take_over, ToNanoseconds(clock_()));
}

void LeaseTable::Grant(const RobotId& robot, std::int64_t token) {
  EndStream end_old;
  {
    absl::MutexLock lock(&mutex_);
    end_old = TakeEnd(book_.Grant(robot, token, ToNanoseconds(clock_())));
  }
  if (end_old) end_old(LeaseSuperseded(robot));
}

void LeaseTable::Remove(const RobotId& robot) {
  EndStream end;
  {
    absl::MutexLock lock(&mutex_);
    end = TakeEnd(book_.Remove(robot));
  }
  if (end) end(RobotNotFound(robot));
}

absl::Status LeaseTable::Release(const RobotId& robot, std::optional<std::int64_t> token) {
  EndStream end;
  {
    absl::MutexLock lock(&mutex_);
    PLUMESCOUT_ASSIGN_OR_RETURN(const StreamId ended, book_.Release(robot, token));
    end = TakeEnd(ended);
  }
  if (end) end(LeaseSuperseded(robot));
  return absl::OkStatus();
}

LeaseStanding LeaseTable::Standing(const RobotId& robot) const {
  absl::MutexLock lock(&mutex_);
  return book_.Standing(robot, ToNanoseconds(clock_()));
}

absl::Duration LeaseTable::TimeLeft(const RobotId& robot) const {
  absl::MutexLock lock(&mutex_);
  const auto left_ns = book_.TimeLeft_ns(robot, ToNanoseconds(clock_()));
  return left_ns ? absl::Nanoseconds(*left_ns) : absl::InfiniteDuration();
}

std::map<RobotId, std::int64_t> LeaseTable::Released() const {
  absl::MutexLock lock(&mutex_);
  return book_.Released();
}

absl::Status LeaseTable::Check(const RobotId& robot, std::int64_t token) const {
  absl::MutexLock lock(&mutex_);
  return book_.Check(robot, token);
}

absl::Status LeaseTable::CheckNotReleased(const RobotId& robot, std::int64_t token) const {
  const absl::Status status = Check(robot, token);
  return absl::IsNotFound(status) ? absl::OkStatus() : status;
}

absl::Status LeaseTable::Use(const RobotId& robot, std::int64_t token) {
  absl::MutexLock lock(&mutex_);
  return book_.Use(robot, token, ToNanoseconds(clock_()));
}

absl::StatusOr<StreamId> LeaseTable::OpenStream(const RobotId& robot, std::int64_t token,
                                                EndStream end) {
  EndStream end_old;
  LeaseBook::OpenedStream opened;
  {
    absl::MutexLock lock(&mutex_);
    PLUMESCOUT_ASSIGN_OR_RETURN(opened, book_.OpenStream(robot, token, ToNanoseconds(clock_())));
    end_old = TakeEnd(opened.replaced);
    ends_.emplace(opened.stream, std::move(end));
  }
  if (end_old) end_old(StreamReplaced(robot));
  return opened.stream;
}

void LeaseTable::CloseStream(const RobotId& robot, StreamId stream) {
  absl::MutexLock lock(&mutex_);
  book_.CloseStream(robot, stream, ToNanoseconds(clock_()));
  ends_.erase(stream);
}

void LeaseTable::EndAll(const absl::Status& status) {
  std::map<StreamId, EndStream> ends;
  {
    absl::MutexLock lock(&mutex_);
    ends.swap(ends_);
    book_.CloseAllStreams();
  }
  for (const auto& [stream, end] : ends) {
    if (end) end(status);
  }
}

LeaseTable::EndStream LeaseTable::TakeEnd(StreamId stream) {
  const auto found = ends_.extract(stream);
  return found.empty() ? nullptr : std::move(found.mapped());
}

int LeaseTable::robot_count() const {
  absl::MutexLock lock(&mutex_);
  return book_.robot_count();
}

}  // namespace plumescout::server
