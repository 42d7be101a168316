// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/call_stop.h"

#include <utility>

#include "server/base/errors.h"

namespace plumescout::server {

CallStop::CallStop(std::shared_ptr<UnaryCall> call, std::shared_ptr<MissionHost> host)
    : call_(std::move(call)),
      host_(std::move(host)),
      listener_(host_->end_listeners().Add([ending = ending_](const absl::Status& status) {
        absl::MutexLock lock(&ending->mutex);
        ending->status = status;
      })) {}

absl::Status CallStop::AnswerOf(const absl::Status& status) const {
  if (!absl::IsCancelled(status)) return status;
  const absl::Status reason = why();
  return reason.ok() ? status : reason;
}

absl::Status CallStop::why() const {
  if (call_->is_cancelled()) return GivenUp();
  if (SteadyNow() >= call_->info().deadline) {
    return absl::DeadlineExceededError("the past of the mission was still being read");
  }
  absl::MutexLock lock(&ending_->mutex);
  return ending_->status;
}

}  // namespace plumescout::server
