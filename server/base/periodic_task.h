// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <thread>

#include "absl/time/time.h"
#include "server/base/stop_signal.h"

namespace plumescout::server {

// Does something every now and then, on a thread of its own: it may take long.
class PeriodicTask {
 public:
  // The first time after `period`.
  PeriodicTask(absl::Duration period, std::function<void()> task);
  // Waits for the task that runs.
  ~PeriodicTask();
  PeriodicTask(const PeriodicTask&) = delete;
  PeriodicTask& operator=(const PeriodicTask&) = delete;

 private:
  void Run();

  const absl::Duration period_;
  const std::function<void()> task_;

  StopSignal stop_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace plumescout::server
