// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/color_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace color_scale_test {

// Lightness L* of CIE 1976 (Y of sRGB, D65): another model than the one the maps are made in.
double Lightness(Rgb color) {
  const auto linear = [](std::uint8_t value) {
    const double x = value / 255.0;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  };
  const double y =
      0.2126 * linear(color.red) + 0.7152 * linear(color.green) + 0.0722 * linear(color.blue);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

class ColorMaps : public testing::TestWithParam<ColorMap> {};
INSTANTIATE_TEST_SUITE_P(All, ColorMaps, testing::Values(ColorMap::kGas, ColorMap::kUncertainty));

TEST_P(ColorMaps, LightnessGrowsAllTheWay) {
  double last = -1.0;
  for (int i = 0; i <= 20; ++i) {
    const double lightness = Lightness(ColorAt(GetParam(), i / 20.0));
    EXPECT_GT(lightness, last) << i;
    last = lightness;
  }
}

TEST_P(ColorMaps, LightnessGrowsEvenly) {
  const double first = Lightness(ColorAt(GetParam(), 0.0));
  const double last = Lightness(ColorAt(GetParam(), 1.0));
  EXPECT_GT(last - first, 60.0);  // of 100: told apart in grey
  for (int i = 1; i < 10; ++i) {
    const double even = first + i / 10.0 * (last - first);
    EXPECT_NEAR(Lightness(ColorAt(GetParam(), i / 10.0)), even, 5.0) << i;
  }
}

TEST_P(ColorMaps, BeyondTheEndsIsTheEnd) {
  EXPECT_EQ(ColorAt(GetParam(), -3.0), ColorAt(GetParam(), 0.0));
  EXPECT_EQ(ColorAt(GetParam(), 7.0), ColorAt(GetParam(), 1.0));
}

TEST(ColorScale, LinearSharesAreProportional) {
  const ColorScale scale{ColorMap::kGas, 10.0, 30.0, false};
  EXPECT_DOUBLE_EQ(scale.Share(10.0), 0.0);
  EXPECT_DOUBLE_EQ(scale.Share(15.0), 0.25);
  EXPECT_DOUBLE_EQ(scale.Share(99.0), 1.0);
}

TEST(ColorScale, LogarithmicSharesGrowByFactors) {
  const ColorScale scale{ColorMap::kGas, 0.1, 1000.0, true};
  EXPECT_NEAR(scale.Share(1.0), 0.25, 1e-12);
  EXPECT_NEAR(scale.Share(10.0), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(scale.Share(0.0), 0.0);
  EXPECT_DOUBLE_EQ(scale.Share(-5.0), 0.0);
}

}  // namespace color_scale_test
}  // namespace plumescout::lab
