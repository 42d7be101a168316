// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/disc_layout.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace disc_layout_test {

constexpr PixelBox kBounds{0.0, 0.0, 400.0, 300.0};
constexpr double kRadius_px = 10.0;

double Gap_px(PixelPoint a, PixelPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

TEST(DiscLayout, DiscsWithRoomStayWhereTheyAre) {
  const PixelPoint places[] = {{50.0, 50.0}, {100.0, 50.0}, {200.0, 250.0}};
  const auto centers = SpreadDiscs(places, kRadius_px, kBounds);
  ASSERT_EQ(centers.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(Gap_px(centers[i], places[i]), 0.0);
}

TEST(DiscLayout, DiscsOfOnePlaceDoNotMeet) {
  const std::vector<PixelPoint> places(12, {200.0, 150.0});
  const auto centers = SpreadDiscs(places, kRadius_px, kBounds);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    EXPECT_LT(Gap_px(centers[i], places[i]), 8.0 * kRadius_px);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE(Gap_px(centers[i], centers[j]), 2.0 * kRadius_px);
  }
}

TEST(DiscLayout, DiscsStayInTheBounds) {
  const std::vector<PixelPoint> places(4, {0.0, 300.0});  // in the corner
  for (const PixelPoint& center : SpreadDiscs(places, kRadius_px, kBounds)) {
    EXPECT_GE(center.x, kRadius_px);
    EXPECT_LE(center.y, kBounds.height - kRadius_px);
  }
}

TEST(DiscLayout, WithoutAnyRoomTheyStayWhereTheyAre) {
  const std::vector<PixelPoint> places(3, {5.0, 5.0});
  for (const PixelPoint& center : SpreadDiscs(places, kRadius_px, {0.0, 0.0, 12.0, 12.0})) {
    EXPECT_EQ(Gap_px(center, {5.0, 5.0}), 0.0);
  }
}

}  // namespace disc_layout_test
}  // namespace plumescout::lab
