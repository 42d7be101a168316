// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/heap.h"

#include <malloc.h>

namespace plumescout::server {

void ReturnLargeBlocks() {
  constexpr int kLarge_bytes = 1 << 20;
  constexpr int kKept_bytes = 8 << 20;  // free at the top of a heap
  mallopt(M_MMAP_THRESHOLD, kLarge_bytes);
  mallopt(M_TRIM_THRESHOLD, kKept_bytes);
}

}  // namespace plumescout::server
