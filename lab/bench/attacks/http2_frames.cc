// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/attacks/http2_frames.h"

#include "absl/strings/str_cat.h"

namespace plumescout::lab {

std::string Bytes(std::initializer_list<int> values) {
  std::string bytes;
  for (const int value : values) bytes.push_back(static_cast<char>(value));
  return bytes;
}

std::string BigEndian(std::uint32_t value) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) {
    bytes.push_back(static_cast<char>((value >> shift) & 0xFFu));
  }
  return bytes;
}

std::uint32_t ReadBigEndian(absl::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes) value = (value << 8) | static_cast<std::uint8_t>(byte);
  return value;
}

std::string Frame(FrameType type, int flags, std::uint32_t stream, absl::string_view payload) {
  return absl::StrCat(BigEndian(static_cast<std::uint32_t>(payload.size())).substr(1),
                      Bytes({static_cast<int>(type), flags}), BigEndian(stream), payload);
}

std::string CallHeaders() {
  const auto text = [](const std::string& value) {
    return absl::StrCat(Bytes({static_cast<int>(value.size())}), value);
  };
  constexpr int kPost = 0x83;
  constexpr int kHttp = 0x86;
  constexpr int kPath = 0x04;
  constexpr int kAuthority = 0x01;
  return absl::StrCat(Bytes({kPost, kHttp, kPath}),
                      text("/plumescout.v1.MissionService/ListMissions"), Bytes({kAuthority}),
                      text("localhost"), Bytes({0x0F, 0x10}), text("application/grpc"),
                      Bytes({0x00}), text("te"), text("trailers"));
}

}  // namespace plumescout::lab
