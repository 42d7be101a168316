// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace plumescout::server {

// Bounds of the buckets of every histogram of times: a step of 2 to 2.5 from the quickest calls to
// the longest searches.
inline const std::vector<double>& DurationBuckets_s() {
  static const auto& buckets =
      *new std::vector<double>{0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1,
                               0.25,   0.5,   1.0,    2.5,   5.0,  10.0,  30.0, 60.0};
  return buckets;
}

}  // namespace plumescout::server
