// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace plumescout::server {

// How busy a pool of threads is.
struct PoolLoad {
  std::string name;
  int threads = 0;
  int busy_threads = 0;
  int queued = 0;
  int max_queued = 0;
  std::int64_t refused = 0;  // so far, for want of room
};

}  // namespace plumescout::server
