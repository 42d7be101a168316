// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thread>

#include "absl/synchronization/notification.h"
#include "absl/time/time.h"

namespace plumescout::server {

// Ends the process with `exit_code` unless it is destroyed in time: for a stop that something holds
// up. Nothing is lost that was acknowledged as durable.
class ExitTimer {
 public:
  ExitTimer(absl::Duration limit, int exit_code);
  ~ExitTimer();
  ExitTimer(const ExitTimer&) = delete;
  ExitTimer& operator=(const ExitTimer&) = delete;

 private:
  absl::Notification in_time_;
  std::thread thread_;  // last: it uses the above
};

}  // namespace plumescout::server
