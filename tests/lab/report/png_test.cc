// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/png.h"

#include <gtest/gtest.h>

#include <string>

#include "core/types/rng.h"
#include "formats/file_io.h"
#include "lab/report/cairo_image.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace png_test {

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
  const TempFolder folder;
  const Image image = RandomImage(37, 23);
  ASSERT_TRUE(WritePng(image, folder.File("a.png")).ok());
  const CairoSurface read(cairo_image_surface_create_from_png(folder.File("a.png").c_str()));
  EXPECT_EQ(FromCairo(read.get()), image);
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

}  // namespace png_test
}  // namespace plumescout::lab
