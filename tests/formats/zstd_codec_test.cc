// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/zstd_codec.h"

#include <gtest/gtest.h>

#include <string>

#include "core/types/rng.h"

namespace plumescout {
namespace zstd_codec_test {

std::string RandomText(std::size_t size) {
  Rng rng(7);
  std::string text(size, '\0');
  for (char& c : text) c = static_cast<char>('a' + rng.Below(8));
  return text;
}

TEST(ZstdCodec, EveryByteComesBack) {
  const std::string text = RandomText(100'000);
  const std::string frame = *CompressZstd(text);
  EXPECT_LT(frame.size(), text.size() / 2);  // three of eight bits carry information
  std::string back(text.size(), '\0');
  ASSERT_TRUE(DecompressZstd(frame, back.data(), back.size()).ok());
  EXPECT_EQ(back, text);
}

TEST(ZstdCodec, NothingComesBackAsNothing) {
  const std::string frame = *CompressZstd("");
  EXPECT_TRUE(DecompressZstd(frame, nullptr, 0).ok());
}

TEST(ZstdCodec, AnotherSizeThanExpectedIsDataLoss) {
  const std::string frame = *CompressZstd("twelve bytes");
  std::string back(64, '\0');
  EXPECT_EQ(DecompressZstd(frame, back.data(), 11).code(), absl::StatusCode::kDataLoss);
  EXPECT_EQ(DecompressZstd(frame, back.data(), 13).code(), absl::StatusCode::kDataLoss);
}

TEST(ZstdCodec, EveryTruncationIsDataLoss) {
  const std::string frame = *CompressZstd("some text, some text, some text");
  std::string back(31, '\0');
  ASSERT_TRUE(DecompressZstd(frame, back.data(), back.size()).ok());
  for (std::size_t size = 0; size < frame.size(); ++size) {
    ASSERT_EQ(DecompressZstd(frame.substr(0, size), back.data(), back.size()).code(),
              absl::StatusCode::kDataLoss)
        << size;
  }
}

}  // namespace zstd_codec_test
}  // namespace plumescout
