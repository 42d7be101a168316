// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/cairo_image.h"

#include <gtest/gtest.h>

namespace plumescout::lab {
namespace cairo_image_test {

TEST(CairoImage, EveryPixelComesBack) {
  Image image(3, 2, {1, 2, 3});  // rows of three pixels
  image.At(2, 0) = {255, 128, 0};
  image.At(0, 1) = {7, 0, 200};
  EXPECT_EQ(FromCairo(ToCairo(image).get()), image);
}

}  // namespace cairo_image_test
}  // namespace plumescout::lab
