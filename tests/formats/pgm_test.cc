// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/pgm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "formats/file_io.h"
#include "tests/support/temp_folder.h"

namespace plumescout {
namespace pgm_test {

using testing::ElementsAre;
using testing::HasSubstr;

absl::StatusOr<GrayImage> ReadBytes(const std::string& bytes) {
  const TempFolder folder;
  EXPECT_TRUE(WriteFile(folder.File("map.pgm"), bytes).ok());
  return ReadPgm(folder.File("map.pgm"));
}

TEST(Pgm, WhatIsWrittenComesBack) {
  const TempFolder folder;
  const GrayImage image{3, 2, {0, 1, 127, 128, 254, 255}};
  ASSERT_TRUE(WritePgm(image, folder.File("a.pgm")).ok());
  EXPECT_EQ(*ReadPgm(folder.File("a.pgm")), image);
}

TEST(Pgm, CommentsInTheHeaderAreSkipped) {
  const auto image = ReadBytes("P5\n# made by hand\n2 # columns\n  1\n#\n255\nab");
  ASSERT_TRUE(image.ok()) << image.status();
  EXPECT_EQ(image->width, 2);
  EXPECT_EQ(image->height, 1);
  EXPECT_THAT(image->pixels, ElementsAre('a', 'b'));
}

TEST(Pgm, PixelsThatLookLikeBlanksOrCommentsArePixels) {
  const auto image = ReadBytes("P5 3 1 255\n \n#");
  ASSERT_TRUE(image.ok()) << image.status();
  EXPECT_THAT(image->pixels, ElementsAre(' ', '\n', '#'));
}

TEST(Pgm, EveryTruncationIsDataLossAndNamesTheFile) {
  const std::string bytes = "P5\n2 2\n255\nabcd";
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    // "P5\n2 2\n25" is whole so far, with another number of greys.
    const auto code =
        size == 9 || size == 8 ? absl::StatusCode::kInvalidArgument : absl::StatusCode::kDataLoss;
    const auto image = ReadBytes(bytes.substr(0, size));
    ASSERT_EQ(image.status().code(), code) << size;
    ASSERT_THAT(std::string(image.status().message()), HasSubstr("map.pgm"));
  }
}

TEST(Pgm, SizesOutOfRangeAreRefused) {
  for (const char* header : {"P5 0 5 255\n", "P5 2147483647 2147483647 255\n", "P5 8193 8193 255\n",
                             "P5 1 1 65535\n", "P5 1 1 0\n"}) {
    EXPECT_EQ(ReadBytes(std::string(header) + "x").status().code(),
              absl::StatusCode::kInvalidArgument)
        << header;
  }
}

TEST(Pgm, HeadersThatDoNotParseAreDataLoss) {
  for (const char* bytes : {"P2 1 1 255\n1", "P5 -1 1 255\nx", "P5 99999999999 1 255\nx",
                            "P5 a 1 255\nx", "P5 # only a comment"}) {
    EXPECT_EQ(ReadBytes(bytes).status().code(), absl::StatusCode::kDataLoss) << bytes;
  }
}

TEST(Pgm, FromMemoryIsTheSamePicture) {
  const auto image = ParsePgm("P5 # comment\n2 2 255\nabcd");
  ASSERT_TRUE(image.ok()) << image.status();
  EXPECT_EQ(*image, (GrayImage{2, 2, {'a', 'b', 'c', 'd'}}));
  EXPECT_EQ(std::string(ParsePgm("P5 2 2 255\nabc").status().message()),
            "pixels are missing: 3 of 4");
}

TEST(Pgm, AMissingFileIsNotFound) {
  EXPECT_EQ(ReadPgm("/nowhere/a.pgm").status().code(), absl::StatusCode::kNotFound);
}

TEST(Pgm, PixelsThatDoNotFillThePictureAreNotWritten) {
  const TempFolder folder;
  EXPECT_EQ(WritePgm({2, 2, {1, 2, 3}}, folder.File("a.pgm")).code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(WritePgm({0, 0, {}}, folder.File("a.pgm")).code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace pgm_test
}  // namespace plumescout
