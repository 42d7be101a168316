// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/periodic_task.h"

#include <utility>

namespace plumescout::server {

PeriodicTask::PeriodicTask(absl::Duration period, std::function<void()> task)
    : period_(period), task_(std::move(task)), thread_([this] { Run(); }) {}

PeriodicTask::~PeriodicTask() {
  stop_.Stop();
  thread_.join();
}

void PeriodicTask::Run() {
  while (!stop_.AwaitStop(After(SteadyNow(), period_))) task_();
}

}  // namespace plumescout::server
