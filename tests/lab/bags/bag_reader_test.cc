// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bags/bag_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/bags/bag_files.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace bag_reader_test {

TEST(OpenBag, KnowsFilesByTheirFirstBytes) {
  const TempFolder folder;
  WriteMcapBag(folder.File("a"), RoomBag(2));
  WriteSqliteBag(folder.File("b"), RoomBag(2));
  ASSERT_TRUE(WriteFile(folder.File("c"), "something else").ok());
  for (const char* name : {"a", "b"}) {
    const auto bag = OpenBag(folder.File(name), {"/scan"});
    ASSERT_TRUE(bag.ok()) << bag.status();
    EXPECT_THAT(ReadAll(**bag).messages, ::testing::SizeIs(2)) << name;
  }
  EXPECT_TRUE(absl::IsInvalidArgument(OpenBag(folder.File("c"), {}).status()));
  EXPECT_TRUE(absl::IsInvalidArgument(OpenBag(folder.path(), {}).status()));
  EXPECT_TRUE(absl::IsNotFound(OpenBag(folder.File("d"), {}).status()));
}

}  // namespace bag_reader_test
}  // namespace plumescout::lab
