// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/journal/varint.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

namespace plumescout {
namespace varint_test {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();

std::string Bytes(std::uint64_t value) {
  std::string bytes;
  AppendVarint(value, bytes);
  return bytes;
}

bool IsVarint(const std::string& bytes) {
  absl::string_view rest = bytes;
  std::uint64_t value = 0;
  return TakeVarint(rest, value);
}

TEST(Varint, TakesAsManyBytesAsItNeeds) {
  EXPECT_EQ(Bytes(0), std::string(1, '\0'));
  EXPECT_EQ(Bytes(127), "\x7F");
  EXPECT_EQ(Bytes(300), "\xAC\x02");
  EXPECT_EQ(Bytes(kMost).size(), 10U);
}

TEST(Varint, ComesBackAndLeavesTheRest) {
  for (int shift = 0; shift < 64; ++shift) {
    for (const std::uint64_t value : {std::uint64_t{1} << shift, (std::uint64_t{1} << shift) - 1,
                                      kMost >> shift, kMost - (std::uint64_t{1} << shift)}) {
      const std::string bytes = Bytes(value) + "x";
      absl::string_view rest = bytes;
      std::uint64_t back = 0;
      ASSERT_TRUE(TakeVarint(rest, back)) << value;
      EXPECT_EQ(back, value);
      EXPECT_EQ(rest, "x");
    }
  }
}

TEST(Varint, HasOneForm) {
  EXPECT_FALSE(IsVarint(""));
  EXPECT_FALSE(IsVarint("\x80"));
  EXPECT_FALSE(IsVarint(std::string("\x80\x00", 2)));  // 0 in two bytes
  EXPECT_TRUE(IsVarint(std::string(9, '\xFF') + '\x01'));
  EXPECT_FALSE(IsVarint(std::string(9, '\xFF') + '\x02'));  // 65 bits
  EXPECT_FALSE(IsVarint(std::string(10, '\xFF') + '\x01'));
}

TEST(ZigZag, IsSmallOnBothSidesOfZero) {
  EXPECT_EQ(ZigZag(0), 0U);
  EXPECT_EQ(ZigZag(-1), 1U);
  EXPECT_EQ(ZigZag(1), 2U);
  EXPECT_EQ(ZigZag(-64), 127U);
  for (const std::int64_t value :
       {std::int64_t{0}, std::int64_t{-1}, std::int64_t{12345}, std::int64_t{-12345},
        std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()}) {
    EXPECT_EQ(UnZigZag(ZigZag(value)), value);
  }
}

}  // namespace varint_test
}  // namespace plumescout
