// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/time/time.h"
#include "core/types/rng.h"

namespace plumescout::client {

// How long to wait between attempts on a broken link.
struct BackoffOptions {
  absl::Duration initial = absl::Milliseconds(100);
  absl::Duration maximum = absl::Seconds(2);
  double factor = 1.6;
  double jitter = 0.2;  // share by which each wait is spread, so that robots do not return in step
  std::uint64_t seed = 1;  // of the jitter
};

// Waits that grow exponentially up to a bound, each times a random factor in [1 - jitter, 1 +
// jitter].
class Backoff {
 public:
  explicit Backoff(const BackoffOptions& options);

  absl::Duration Next();
  void Reset() { base_ = options_.initial; }

 private:
  BackoffOptions options_;
  absl::Duration base_;
  Rng rng_;
};

}  // namespace plumescout::client
