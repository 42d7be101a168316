// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plumescout::server {

// What this process uses now.
struct ProcessUsage {
  std::int64_t resident_bytes = 0;
  int open_fds = 0;
  std::int64_t max_fds = 0;  // the soft limit
  double cpu_s = 0.0;        // since its start, user and system
  int threads = 0;
};

// What cannot be read is 0.
ProcessUsage ReadProcessUsage();

}  // namespace plumescout::server
