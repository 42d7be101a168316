// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/rectangle.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace rectangle_test {

constexpr Rectangle kRectangle{{1.0, -2.0}, {4.0, 2.0}};

TEST(RectangleTest, HasASize) {
  EXPECT_EQ(kRectangle.width_m(), 3.0);
  EXPECT_EQ(kRectangle.height_m(), 4.0);
  EXPECT_EQ(Rectangle::Sized({1.0, -2.0}, 3.0, 4.0), kRectangle);
}

TEST(RectangleTest, SurroundsWhatIsNotOnItsEdge) {
  EXPECT_TRUE(kRectangle.Surrounds({1.5, 0.0}));
  for (const Point2 out : {Point2{1.0, 0.0}, {4.0, 0.0}, {2.0, -2.0}, {2.0, 2.0}, {5.0, 9.0}}) {
    EXPECT_FALSE(kRectangle.Surrounds(out)) << out.x_m << ", " << out.y_m;
  }
}

TEST(RectangleTest, OverlapsInMoreThanAnEdge) {
  EXPECT_TRUE(kRectangle.Overlaps({{3.5, 1.5}, {9.0, 9.0}}));
  EXPECT_TRUE(kRectangle.Overlaps({{2.0, 0.0}, {3.0, 1.0}}));
  for (const Rectangle& beside : {Rectangle{{4.0, -2.0}, {9.0, 2.0}},
                                  {{0.0, -2.0}, {1.0, 2.0}},
                                  {{1.0, 2.0}, {4.0, 3.0}},
                                  {{1.0, -5.0}, {4.0, -2.0}}}) {
    EXPECT_FALSE(kRectangle.Overlaps(beside));
    EXPECT_TRUE(kRectangle.Grown(0.5).Overlaps(beside));
  }
}

TEST(RectangleTest, GrowsAndShrinksOnEachSide) {
  EXPECT_EQ(kRectangle.Grown(0.5), (Rectangle{{0.5, -2.5}, {4.5, 2.5}}));
  EXPECT_EQ(kRectangle.Grown(-0.5), (Rectangle{{1.5, -1.5}, {3.5, 1.5}}));
}

TEST(RectangleTest, TheSmallestWithBothHoldsBoth) {
  EXPECT_EQ(kRectangle.With({{0.0, 0.0}, {2.0, 7.0}}), (Rectangle{{0.0, -2.0}, {4.0, 7.0}}));
  EXPECT_EQ(kRectangle.With({{2.0, 0.0}, {3.0, 1.0}}), kRectangle);
}

TEST(RectangleTest, DistanceIsToTheNearestPoint) {
  EXPECT_EQ(kRectangle.Distance_m({2.0, 1.0}), 0.0);
  EXPECT_EQ(kRectangle.Distance_m({4.0, 0.0}), 0.0);
  EXPECT_EQ(kRectangle.Distance_m({-1.0, 1.0}), 2.0);
  EXPECT_EQ(kRectangle.Distance_m({7.0, 6.0}), 5.0);
  EXPECT_EQ(kRectangle.Distance_m({2.0, -3.5}), 1.5);
}

}  // namespace rectangle_test
}  // namespace plumescout
