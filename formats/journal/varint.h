// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/strings/string_view.h"

namespace plumescout {

// Whole numbers in as many bytes as they need: seven bits a byte, the low ones first; the top bit
// says that more follow (LEB128, as protobuf has it).
inline void AppendVarint(std::uint64_t value, std::string& bytes) {
  for (; value >= 0x80; value >>= 7) bytes.push_back(static_cast<char>((value & 0x7F) | 0x80));
  bytes.push_back(static_cast<char>(value));
}

// Takes a number off the front of `rest`. False, with `rest` anywhere, if it is cut short, has more
// than 64 bits, or has a byte more than it needs.
inline bool TakeVarint(absl::string_view& rest, std::uint64_t& value) {
  constexpr int kLastShift = 63;  // one bit is left for the tenth byte
  value = 0;
  for (int shift = 0; shift <= kLastShift && !rest.empty(); shift += 7) {
    const auto byte = static_cast<std::uint8_t>(rest.front());
    rest.remove_prefix(1);
    if (shift == kLastShift && byte > 1) return false;
    value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    if (byte < 0x80) return byte != 0 || shift == 0;
  }
  return false;
}

// 0, -1, 1, -2 ... as 0, 1, 2, 3 ...: numbers near 0 of either sign are short.
constexpr std::uint64_t ZigZag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
constexpr std::int64_t UnZigZag(std::uint64_t value) {
  return static_cast<std::int64_t>((value >> 1) ^ (~(value & 1) + 1));
}

}  // namespace plumescout
