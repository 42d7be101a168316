// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "client/backoff.h"
#include "client/planner_client.h"
#include "client/robot_observer.h"
#include "core/types/ids.h"
#include "core/types/robot_notice.h"

namespace plumescout::client {

// Keeps the newest of what the service tells a robot unasked. A watch that breaks is opened again;
// meanwhile it is as if nothing had been told. Nothing blocks. Not thread-safe.
class NoticeReader {
 public:
  // Client and observer, who is told of doubts in the robot's place, outlive it. Not `enabled`: it
  // never asks.
  NoticeReader(PlannerClient& client, const BackoffOptions& backoff, bool enabled = true,
               RobotObserver* observer = nullptr)
      : client_(client), backoff_(backoff), is_served_(enabled), observer_(observer) {}

  // Takes in what has come by now, and sees to it that a watch of this session is open.
  void Poll(const RobotSession& session, absl::Time now);

  const RobotStanding& standing() const { return standing_; }
  // Why the plan should not be driven on; null: nothing is against it.
  const PlanInvalidated* FindInvalidation(PlanId plan) const {
    return invalidated_ && invalidated_->plan == plan ? &*invalidated_ : nullptr;
  }
  // Whether to end the leg of that plan: it does not stand, another was assigned since, or the
  // robot has been ordered home since it asked. `homeward`: it knew that then.
  bool TellsToStop(PlanId plan, bool homeward) const {
    return FindInvalidation(plan) != nullptr || assigned_ > plan ||
           (standing_.ordered_home && !homeward);
  }

 private:
  void Open(const RobotSession& session, absl::Time now);
  void Take(RobotNotice notice);
  void Take(const RobotStanding& standing);
  void Break(const absl::Status& why, absl::Time now);

  PlannerClient& client_;
  Backoff backoff_;
  bool is_served_;  // by a service that knows of watches
  absl::Time open_at_ = absl::InfinitePast();
  std::int64_t lease_token_ = 0;  // of the watch
  std::unique_ptr<RobotWatch> watch_;
  RobotStanding standing_;
  std::optional<PlanInvalidated> invalidated_;
  PlanId assigned_ = 0;  // the newest; 0: none
  RobotObserver* observer_;
  bool place_doubted_ = false;  // by the latest standing, whatever became of that watch
};

}  // namespace plumescout::client
