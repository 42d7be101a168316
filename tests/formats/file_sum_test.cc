// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/file_sum.h"

#include <gtest/gtest.h>

#include "absl/strings/escaping.h"

namespace plumescout {
namespace file_sum_test {

TEST(FileSumTest, IsThatOfAllBytesHoweverTheyCame) {
  FileSum sum;
  sum.Add("1234");
  sum.Add("");
  sum.Add("56789");
  EXPECT_EQ(sum.bytes(), 9);
  EXPECT_EQ(sum.crc32(), 0xCBF43926u);
  EXPECT_EQ(absl::BytesToHexString(sum.TakeSha256()),
            "15e2b0d3c33891ebb0f1ef609ec419420c20e320ce94c65fbc8c3312448eb225");
}

TEST(FileSumTest, NothingHasASumToo) {
  FileSum sum;
  EXPECT_EQ(sum.crc32(), 0u);
  EXPECT_EQ(absl::BytesToHexString(sum.TakeSha256()),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

}  // namespace file_sum_test
}  // namespace plumescout
