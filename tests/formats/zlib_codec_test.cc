// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/zlib_codec.h"

#include <gtest/gtest.h>

#include <cstdint>

#include <string>

#include "absl/strings/string_view.h"

namespace plumescout {
namespace zlib_codec_test {

constexpr std::uint64_t kNoLimit = 1 << 30;

TEST(ZlibCodec, WhatIsPackedComesBack) {
  std::string text;
  for (int i = 0; i < 200'000; ++i) text += static_cast<char>(std::int64_t{i} * i / 7);
  for (const std::string& bytes : {std::string(), std::string("gas"), text}) {
    for (const int level : {-1, 1, 9}) {
      EXPECT_EQ(DecompressZlib(CompressZlib(bytes, level), kNoLimit).value(), bytes);
    }
  }
}

TEST(ZlibCodec, ReadsAStreamOfTheSpecification) {
  // "a" in a stored block of RFC 1951, with its Adler-32 of RFC 1950.
  constexpr absl::string_view kStored("\x78\x01\x01\x01\x00\xfe\xff\x61\x00\x62\x00\x62", 12);
  EXPECT_EQ(DecompressZlib(kStored, kNoLimit).value(), "a");
}

TEST(ZlibCodec, DamageIsDataLoss) {
  const std::string packed = CompressZlib(std::string(1000, 'x'));
  std::string flipped = packed;
  flipped[flipped.size() - 1] ^= 1;  // of the checksum
  for (const std::string& bytes : {std::string(), std::string("no zlib"),
                                   packed.substr(0, packed.size() - 1), flipped, packed + "more"}) {
    EXPECT_EQ(DecompressZlib(bytes, kNoLimit).status().code(), absl::StatusCode::kDataLoss);
  }
}

TEST(ZlibCodec, ABombIsStopped) {
  const std::string packed = CompressZlib(std::string(10'000'000, '\0'));
  EXPECT_EQ(DecompressZlib(packed, 1'000'000).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace zlib_codec_test
}  // namespace plumescout
