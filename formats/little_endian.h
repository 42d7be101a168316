// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstring>
#include <type_traits>

namespace plumescout {

// Files are little-endian and are read by copying bytes.
static_assert(std::endian::native == std::endian::little);

// The number stored at `bytes`, which need not be aligned.
template <typename T>
requires std::is_arithmetic_v<T> T LoadLittleEndian(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

}  // namespace plumescout
