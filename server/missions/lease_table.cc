// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/lease_table.h"

#include <utility>
#include <vector>

#include "core/types/status_macros.h"
#include "server/base/errors.h"

namespace plumescout::server {

LeaseTable::LeaseTable(absl::Duration hold, std::int64_t first_token, SteadyClock clock)
    : hold_(hold), clock_(std::move(clock)), next_token_(first_token) {}

absl::StatusOr<std::int64_t> LeaseTable::Propose(const RobotId& robot, bool take_over) {
  absl::MutexLock lock(&mutex_);
  const auto found = leases_.find(robot);
  if (found != leases_.end() && !take_over) {
    const Lease& lease = found->second;
    const absl::Duration idle = absl::FromChrono(clock_() - lease.last_use);
    if (lease.stream != nullptr) return LeaseHeld(robot, hold_);
    if (idle < hold_) return LeaseHeld(robot, hold_ - idle);
  }
  return next_token_++;
}

void LeaseTable::Grant(const RobotId& robot, std::int64_t token) {
  EndStream end_old;
  {
    absl::MutexLock lock(&mutex_);
    Lease& lease = leases_[robot];
    end_old = std::exchange(lease.end_stream, nullptr);
    lease.stream = nullptr;
    lease.token = token;
    lease.last_use = clock_();
  }
  if (end_old) end_old(LeaseSuperseded(robot));
}

void LeaseTable::Remove(const RobotId& robot) {
  EndStream end;
  {
    absl::MutexLock lock(&mutex_);
    const auto found = leases_.find(robot);
    if (found == leases_.end()) return;
    end = std::move(found->second.end_stream);
    leases_.erase(found);
  }
  if (end) end(RobotNotFound(robot));
}

absl::StatusOr<LeaseTable::Lease*> LeaseTable::Find(const RobotId& robot, std::int64_t token) {
  const auto found = leases_.find(robot);
  if (found == leases_.end()) return RobotNotFound(robot);
  if (found->second.token != token) return LeaseSuperseded(robot);
  found->second.last_use = clock_();
  return &found->second;
}

absl::Status LeaseTable::Check(const RobotId& robot, std::int64_t token) {
  absl::MutexLock lock(&mutex_);
  return Find(robot, token).status();
}

absl::Status LeaseTable::OpenStream(const RobotId& robot, std::int64_t token, const void* stream,
                                    EndStream end) {
  EndStream end_old;
  {
    absl::MutexLock lock(&mutex_);
    PLUMESCOUT_ASSIGN_OR_RETURN(Lease* const lease, Find(robot, token));
    end_old = std::exchange(lease->end_stream, std::move(end));
    lease->stream = stream;
  }
  if (end_old) end_old(StreamReplaced(robot));
  return absl::OkStatus();
}

void LeaseTable::CloseStream(const RobotId& robot, const void* stream) {
  absl::MutexLock lock(&mutex_);
  const auto found = leases_.find(robot);
  if (found == leases_.end() || found->second.stream != stream) return;
  found->second.stream = nullptr;
  found->second.end_stream = nullptr;
  found->second.last_use = clock_();
}

void LeaseTable::EndAll(const absl::Status& status) {
  std::vector<EndStream> ends;
  {
    absl::MutexLock lock(&mutex_);
    for (auto& [robot, lease] : leases_) {
      if (lease.end_stream) ends.push_back(std::exchange(lease.end_stream, nullptr));
      lease.stream = nullptr;
    }
  }
  for (const EndStream& end : ends) end(status);
}

int LeaseTable::robot_count() const {
  absl::MutexLock lock(&mutex_);
  return static_cast<int>(leases_.size());
}

}  // namespace plumescout::server
