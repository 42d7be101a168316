// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace plumescout {

// Asks memory for the beginning of an array; the processor notices by itself where reading goes on.
// Nothing is read, so there need be nothing: addresses are reckoned as numbers.
inline void PrefetchBytes(const void* begin, std::size_t size) {
  constexpr std::size_t kLine = 64;
  constexpr std::size_t kMost = 8 * kLine;
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  for (std::size_t i = 0; i < std::min(size, kMost); i += kLine) {
    __builtin_prefetch(reinterpret_cast<const void*>(address + i));
  }
}

}  // namespace plumescout
