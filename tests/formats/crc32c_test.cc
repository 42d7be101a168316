// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/crc32c.h"

#include <gtest/gtest.h>

#include <string>

namespace plumescout {
namespace crc32c_test {

// The examples of RFC 3720 appendix B.4, as values (the RFC prints bytes, lowest first).
TEST(Crc32c, TheExamplesOfTheRfcHold) {
  std::string ascending;
  for (char c = 0; c < 32; ++c) ascending += c;
  EXPECT_EQ(Crc32c(std::string(32, '\0')), 0x8A9136AAU);
  EXPECT_EQ(Crc32c(std::string(32, '\xFF')), 0x62A8AB43U);
  EXPECT_EQ(Crc32c(ascending), 0x46DD794EU);
}

TEST(Crc32c, TheCheckValueOfTheCatalogueHolds) { EXPECT_EQ(Crc32c("123456789"), 0xE3069283U); }

TEST(Crc32c, NothingHasChecksumZero) { EXPECT_EQ(Crc32c(""), 0U); }

TEST(Crc32c, PiecesContinue) { EXPECT_EQ(Crc32c("56789", Crc32c("1234")), Crc32c("123456789")); }

}  // namespace crc32c_test
}  // namespace plumescout
