// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <thread>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "server/base/stop_signal.h"

namespace plumescout::server {

// Asks again and again, on a thread of its own, whether the server can be reached. gRPC's listener
// can stop listening for good (when it finds no descriptor left) without a word to anybody.
class SelfProbe {
 public:
  struct Options {
    absl::Duration period = absl::Seconds(5);
    int failures = 3;  // in a row, until the server counts as out of reach
  };
  using Probe = std::function<absl::Status()>;

  // `unreachable` is called once at most, by the probe's thread, with the last failure. `probe`
  // ends by itself in reasonable time.
  SelfProbe(const Options& options, Probe probe,
            std::function<void(const absl::Status&)> unreachable);
  // Waits for a probe that is under way. REQUIRES: not called by `unreachable`.
  ~SelfProbe();
  SelfProbe(const SelfProbe&) = delete;
  SelfProbe& operator=(const SelfProbe&) = delete;

 private:
  void Run();

  const Options options_;
  const Probe probe_;
  const std::function<void(const absl::Status&)> unreachable_;

  StopSignal stop_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace plumescout::server
