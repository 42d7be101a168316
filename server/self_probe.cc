// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/self_probe.h"

#include <utility>

namespace plumescout::server {

SelfProbe::SelfProbe(const Options& options, Probe probe,
                     std::function<void(const absl::Status&)> unreachable)
    : options_(options),
      probe_(std::move(probe)),
      unreachable_(std::move(unreachable)),
      thread_([this] { Run(); }) {}

SelfProbe::~SelfProbe() {
  stop_.Stop();
  thread_.join();
}

void SelfProbe::Run() {
  int failures = 0;
  while (!stop_.AwaitStop(After(SteadyNow(), options_.period))) {
    const absl::Status status = probe_();
    failures = status.ok() ? 0 : failures + 1;
    if (failures == options_.failures) return unreachable_(status);
  }
}

}  // namespace plumescout::server
