// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/lease_book.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/mission/conduct/conduct_errors.h"
#include "core/types/status_macros.h"

namespace plumescout {

std::int64_t FirstLeaseToken(std::uint64_t random_bits) {
  constexpr int kTokensPerLife_bits = 20;
  constexpr std::uint64_t kLifeMask =
      (static_cast<std::uint64_t>(kLeaseTokenEnd) >> (kTokensPerLife_bits + 1)) - 1;
  return static_cast<std::int64_t>((random_bits & kLifeMask) << kTokensPerLife_bits) + 1;
}

absl::StatusOr<std::int64_t> LeaseBook::Propose(const RobotId& robot, bool take_over,
                                                std::int64_t now_ns) const {
  const auto found = leases_.find(robot);
  if (found != leases_.end() && !take_over && !found->second.released) {
    const Lease& lease = found->second;
    const std::int64_t idle_ns = now_ns - lease.last_use_ns;
    if (lease.stream != 0) return LeaseHeld(robot, hold_ns_);
    if (idle_ns < hold_ns_) return LeaseHeld(robot, hold_ns_ - idle_ns);
  }
  return next_token_;
}

StreamId LeaseBook::Grant(const RobotId& robot, std::int64_t token, std::int64_t now_ns) {
  Lease& lease = leases_[robot];
  assert(token > lease.token);
  next_token_ = std::max(next_token_, token + 1);
  lease.token = token;
  lease.last_use_ns = now_ns;
  lease.released = false;
  return std::exchange(lease.stream, 0);
}

StreamId LeaseBook::Remove(const RobotId& robot) {
  const auto found = leases_.find(robot);
  if (found == leases_.end()) return 0;
  const StreamId ended = found->second.stream;
  leases_.erase(found);
  return ended;
}

absl::StatusOr<StreamId> LeaseBook::Release(const RobotId& robot,
                                            std::optional<std::int64_t> token) {
  const auto found = leases_.find(robot);
  if (found == leases_.end()) return RobotNotFound(robot);
  Lease& lease = found->second;
  if (token && lease.token != *token) return LeaseSuperseded(robot);
  lease.released = true;
  return std::exchange(lease.stream, 0);
}

std::map<RobotId, std::int64_t> LeaseBook::Released() const {
  std::map<RobotId, std::int64_t> released;
  for (const auto& [robot, lease] : leases_) {
    if (lease.released) released[robot] = lease.token;
  }
  return released;
}

LeaseStanding LeaseBook::Standing(const RobotId& robot, std::int64_t now_ns) const {
  const auto found = leases_.find(robot);
  if (found == leases_.end() || found->second.released) return {};
  const Lease& lease = found->second;
  const bool streaming = lease.stream != 0;
  return {streaming || now_ns - lease.last_use_ns < hold_ns_, streaming};
}

std::optional<std::int64_t> LeaseBook::TimeLeft_ns(const RobotId& robot,
                                                   std::int64_t now_ns) const {
  const LeaseStanding standing = Standing(robot, now_ns);
  if (standing.streaming) return std::nullopt;
  if (!standing.held) return 0;
  return leases_.at(robot).last_use_ns + hold_ns_ - now_ns;
}

absl::Status LeaseBook::Check(const RobotId& robot, std::int64_t token) const {
  const auto found = leases_.find(robot);
  if (found == leases_.end()) return RobotNotFound(robot);
  const Lease& lease = found->second;
  return lease.token == token && !lease.released ? absl::OkStatus() : LeaseSuperseded(robot);
}

absl::Status LeaseBook::Use(const RobotId& robot, std::int64_t token, std::int64_t now_ns) {
  PLUMESCOUT_RETURN_IF_ERROR(Check(robot, token));
  leases_.at(robot).last_use_ns = now_ns;
  return absl::OkStatus();
}

absl::StatusOr<LeaseBook::OpenedStream> LeaseBook::OpenStream(const RobotId& robot,
                                                              std::int64_t token,
                                                              std::int64_t now_ns) {
  PLUMESCOUT_RETURN_IF_ERROR(Use(robot, token, now_ns));
  const StreamId replaced = std::exchange(leases_.at(robot).stream, ++last_stream_);
  return OpenedStream{last_stream_, replaced};
}

absl::Status LeaseBook::CheckStream(const RobotId& robot, std::int64_t token,
                                    StreamId stream) const {
  PLUMESCOUT_RETURN_IF_ERROR(Check(robot, token));
  return leases_.at(robot).stream == stream ? absl::OkStatus() : StreamReplaced(robot);
}

void LeaseBook::CloseStream(const RobotId& robot, StreamId stream, std::int64_t now_ns) {
  const auto found = leases_.find(robot);
  if (stream == 0 || found == leases_.end() || found->second.stream != stream) return;
  found->second.stream = 0;
  found->second.last_use_ns = now_ns;
}

void LeaseBook::CloseAllStreams() {
  for (auto& [robot, lease] : leases_) lease.stream = 0;
}

}  // namespace plumescout
