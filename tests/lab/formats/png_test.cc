// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/png.h"

#include <gtest/gtest.h>

#include <string>

#include "core/types/rng.h"
#include "formats/file_io.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace {

Image RandomImage(int width, int height) {
  Rng rng(11);
  Image image(width, height);
  for (Rgb& pixel : image.pixels()) {
    pixel = {static_cast<std::uint8_t>(rng.Below(256)), static_cast<std::uint8_t>(rng.Below(256)),
             static_cast<std::uint8_t>(rng.Below(256))};
  }
  return image;
}

TEST(Png, EveryPixelComesBack) {
  const Image image = RandomImage(37, 23);
  EXPECT_EQ(*DecodePng(*EncodePng(image)), image);
}

TEST(Png, TheFileHoldsTheEncodedPicture) {
  const TempFolder folder;
  const Image image = RandomImage(3, 2);
  ASSERT_TRUE(WritePng(image, folder.File("a.png")).ok());
  EXPECT_EQ(*ReadFile(folder.File("a.png"), 4096), *EncodePng(image));
}

TEST(Png, APictureWithoutPixelsIsRefused) {
  EXPECT_EQ(EncodePng(Image()).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(Png, DamageIsDataLoss) {
  const std::string bytes = *EncodePng(RandomImage(37, 23));
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{8}, std::size_t{33}, bytes.size() / 2}) {
    EXPECT_EQ(DecodePng(bytes.substr(0, size)).status().code(), absl::StatusCode::kDataLoss)
        << size;
  }
  EXPECT_EQ(DecodePng("no picture at all").status().code(), absl::StatusCode::kDataLoss);
}

TEST(Png, APictureTooLargeIsRefusedBeforeItIsUnpacked) {
  // Signature, header chunk of a picture of 65535 x 65535 pixels, and a first chunk of data.
  const std::string bytes(
      "\x89PNG\r\n\x1A\n"
      "\0\0\0\x0DIHDR\0\0\xFF\xFF\0\0\xFF\xFF\x08\x02\0\0\0\x39\x67\x4E\x07"
      "\0\0\0\0IDAT\x35\xAF\x06\x1E",
      45);
  EXPECT_EQ(DecodePng(bytes).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace plumescout::lab
