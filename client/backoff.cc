// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/backoff.h"

#include <algorithm>

namespace plumescout::client {

Backoff::Backoff(const BackoffOptions& options)
    : options_(options), base_(options.initial), rng_(options.seed) {}

absl::Duration Backoff::Next() {
  const double spread = rng_.Uniform(1.0 - options_.jitter, 1.0 + options_.jitter);
  const absl::Duration wait = std::min(base_ * spread, options_.maximum);
  base_ = std::min(base_ * options_.factor, options_.maximum);
  return wait;
}

}  // namespace plumescout::client
