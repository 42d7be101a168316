// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "absl/strings/string_view.h"
#include "formats/crc32c.h"

namespace plumescout::server {

// CRC-32C of several values, one behind the other, the same on every machine.
class Checksum {
 public:
  explicit Checksum(std::uint32_t begin = 0) : value_(begin) {}

  Checksum& Add(std::int64_t number) {
    std::array<char, sizeof(number)> bytes{};
    auto rest = static_cast<std::uint64_t>(number);
    for (char& byte : bytes) {
      byte = static_cast<char>(rest & 0xFFU);
      rest >>= 8U;
    }
    value_ = Crc32c(absl::string_view(bytes.data(), bytes.size()), value_);
    return *this;
  }
  // With its length, so that bytes cannot wander to what is added next.
  Checksum& Add(absl::string_view bytes) {
    Add(static_cast<std::int64_t>(bytes.size()));
    value_ = Crc32c(bytes, value_);
    return *this;
  }

  std::uint32_t value() const { return value_; }

 private:
  std::uint32_t value_;
};

// Of a mission's header; the chain of its records begins with it.
inline std::uint32_t HeaderChecksum(absl::string_view key, absl::string_view header) {
  return Checksum().Add(key).Add(header).value();
}

// Of the records up to this one, given that of those before it.
inline std::uint32_t ChainChecksum(std::uint32_t before, std::int64_t number,
                                   absl::string_view bytes) {
  return Checksum(before).Add(number).Add(bytes).value();
}

}  // namespace plumescout::server
