// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/lz4_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "tests/support/lz4_frame.h"

namespace plumescout {
namespace lz4_codec_test {

using testing::HasSubstr;

// Several blocks of 64 KiB.
std::string Text() {
  std::string text;
  for (std::int64_t i = 0; i < 50'000; ++i) text += std::to_string(i * i);
  return text;
}

std::string Unpack(const std::string& frame, std::size_t size, std::string& out) {
  out.assign(size, '\0');
  const absl::Status status = DecompressLz4(frame, out.data(), out.size());
  EXPECT_TRUE(status.ok() || absl::IsDataLoss(status)) << status;
  return std::string(status.message());
}

TEST(Lz4CodecTest, WhatWasPackedComesBack) {
  std::string out;
  for (const std::string& text : {std::string(), std::string("a"), Text()}) {
    EXPECT_EQ(Unpack(support::PackLz4(text), text.size(), out), "");
    EXPECT_EQ(out, text);
  }
}

TEST(Lz4CodecTest, AnotherSizeIsNamed) {
  const std::string frame = support::PackLz4(Text());
  std::string out;
  EXPECT_THAT(Unpack(frame, Text().size() - 1, out), HasSubstr("holds more than"));
  EXPECT_THAT(Unpack(frame, 0, out), HasSubstr("holds more than"));
  EXPECT_THAT(Unpack(frame, Text().size() + 1, out), HasSubstr("holds less than"));
}

TEST(Lz4CodecTest, DamageIsNamed) {
  const std::string frame = support::PackLz4(Text());
  std::string out;
  EXPECT_THAT(Unpack("no lz4 at all", 100, out), HasSubstr("lz4: ERROR_frameType_unknown"));
  EXPECT_THAT(Unpack("", 100, out), HasSubstr("cut short"));
  EXPECT_THAT(Unpack(frame.substr(0, frame.size() / 2), Text().size(), out),
              HasSubstr("cut short"));
  EXPECT_THAT(Unpack(frame + "x", Text().size(), out), HasSubstr("something follows"));
  std::string damaged = frame;
  damaged[frame.size() / 2] ^= 1;
  EXPECT_THAT(Unpack(damaged, Text().size(), out), HasSubstr("lz4: ERROR_"));
}

}  // namespace lz4_codec_test
}  // namespace plumescout
