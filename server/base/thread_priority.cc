// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/thread_priority.h"

#include <sys/resource.h>

namespace plumescout::server {
namespace {

constexpr int kNicer = 10;
constexpr int kNicest = 19;

}  // namespace

void YieldCpuToOthers() {
  // To Linux process 0 is the calling thread.
  const int now = getpriority(PRIO_PROCESS, 0);
  setpriority(PRIO_PROCESS, 0, now + kNicer < kNicest ? now + kNicer : kNicest);
}

}  // namespace plumescout::server
