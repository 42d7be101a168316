// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

#include "absl/strings/string_view.h"

namespace plumescout::lab {

// What an attacker says in HTTP/2 (RFC 9113) without a library that would keep it to the rules.
enum class FrameType : std::uint8_t {
  kData = 0,
  kHeaders = 1,
  kResetStream = 3,
  kSettings = 4,
  kWindowUpdate = 8,
};

inline constexpr char kHttp2Preface[] = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
inline constexpr int kEndHeaders = 0x4;  // a flag of kHeaders

std::string Bytes(std::initializer_list<int> values);
// Of four bytes, the most significant first.
std::string BigEndian(std::uint32_t value);
std::uint32_t ReadBigEndian(absl::string_view bytes);

// RFC 9113, section 4.1.
std::string Frame(FrameType type, int flags, std::uint32_t stream, absl::string_view payload);

// Of a call for the list of missions, as HPACK (RFC 7541) has them, nothing indexed but by the
// static table.
std::string CallHeaders();

}  // namespace plumescout::lab
