// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/crc32c.h"

#include <array>

namespace plumescout {
namespace {

constexpr std::uint32_t kPolynomial = 0x82F63B78;
constexpr int kByteValues = 256;

constexpr std::array<std::uint32_t, kByteValues> MakeTable() {
  std::array<std::uint32_t, kByteValues> table{};
  for (std::uint32_t byte = 0; byte < kByteValues; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? kPolynomial : 0U);
    table[byte] = crc;
  }
  return table;
}

constexpr std::array<std::uint32_t, kByteValues> kTable = MakeTable();

}  // namespace

std::uint32_t Crc32c(absl::string_view bytes, std::uint32_t crc) {
  crc = ~crc;
  for (const char c : bytes) {
    const auto byte = static_cast<std::uint8_t>(c);
    crc = (crc >> 8) ^ kTable[(crc ^ byte) & 0xFFU];
  }
  return ~crc;
}

}  // namespace plumescout
