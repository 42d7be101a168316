// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/heap.h"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "absl/strings/match.h"

namespace plumescout::server {
namespace {

bool EnvironmentSaysHowMany() {
  const char* const tunables = std::getenv("GLIBC_TUNABLES");
  return std::getenv("MALLOC_ARENA_MAX") != nullptr ||
         (tunables != nullptr && absl::StrContains(tunables, "glibc.malloc.arena_max"));
}

}  // namespace

void ReturnLargeBlocks() {
  constexpr int kLarge_bytes = 1 << 20;
  constexpr int kKept_bytes = 8 << 20;  // free at the top of a heap
  mallopt(M_MMAP_THRESHOLD, kLarge_bytes);
  mallopt(M_TRIM_THRESHOLD, kKept_bytes);
}

void LimitArenas() {
  if (EnvironmentSaysHowMany()) return;
  mallopt(M_ARENA_MAX, std::max(2, static_cast<int>(std::thread::hardware_concurrency())));
}

}  // namespace plumescout::server
