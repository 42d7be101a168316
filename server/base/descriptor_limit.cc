// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/descriptor_limit.h"

#include <sys/resource.h>

#include <cerrno>

namespace plumescout::server {

absl::StatusOr<DescriptorLimit> RaiseDescriptorLimit() {
  rlimit limit;
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return absl::ErrnoToStatus(errno, "getrlimit");
  DescriptorLimit raised;
  raised.before = static_cast<std::int64_t>(limit.rlim_cur);
  limit.rlim_cur = limit.rlim_max;
  if (setrlimit(RLIMIT_NOFILE, &limit) != 0) return absl::ErrnoToStatus(errno, "setrlimit");
  raised.now = static_cast<std::int64_t>(limit.rlim_cur);
  return raised;
}

}  // namespace plumescout::server
