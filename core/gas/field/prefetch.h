// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

namespace plumescout {

// Asks memory for the beginning of an array; the processor notices by itself where reading goes on.
inline void PrefetchBytes(const void* begin, std::size_t size) {
  constexpr std::size_t kLine = 64;
  constexpr std::size_t kMost = 8 * kLine;
  for (std::size_t i = 0; i < std::min(size, kMost); i += kLine) {
    __builtin_prefetch(static_cast<const char*>(begin) + i);
  }
}

}  // namespace plumescout
