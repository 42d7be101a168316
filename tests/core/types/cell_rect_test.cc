// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/cell_rect.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace cell_rect_test {

constexpr CellRect kRect{{2, -1}, {5, 1}};

TEST(CellRectTest, EndsBeforeItsEnd) {
  EXPECT_EQ(kRect.width(), 3);
  EXPECT_EQ(kRect.height(), 2);
  EXPECT_EQ(kRect.size(), 6u);
  EXPECT_EQ(CellRect::Sized({2, -1}, 3, 2), kRect);
  for (const Cell in : {Cell{2, -1}, Cell{4, 0}}) EXPECT_TRUE(kRect.Contains(in));
  for (const Cell out : {Cell{1, 0}, Cell{2, -2}, Cell{5, 0}, Cell{4, 1}}) {
    EXPECT_FALSE(kRect.Contains(out)) << out.x << ", " << out.y;
  }
}

TEST(CellRectTest, CoversWhatReachesNoFarther) {
  EXPECT_TRUE(kRect.Covers(kRect));
  EXPECT_TRUE(kRect.Covers({{3, 0}, {5, 1}}));
  for (const CellRect& out :
       {CellRect{{1, 0}, {5, 1}}, {{3, -2}, {5, 1}}, {{3, 0}, {6, 1}}, {{3, 0}, {5, 2}}}) {
    EXPECT_FALSE(kRect.Covers(out));
  }
}

TEST(CellRectTest, OverlapsWhatHasACellInCommon) {
  EXPECT_TRUE(kRect.Overlaps({{4, 0}, {9, 9}}));
  EXPECT_TRUE(kRect.Overlaps({{0, -5}, {3, 0}}));
  for (const CellRect& beside :
       {CellRect{{5, -1}, {9, 1}}, {{0, -1}, {2, 1}}, {{2, 1}, {5, 3}}, {{2, -3}, {5, -1}}}) {
    EXPECT_FALSE(kRect.Overlaps(beside));
    EXPECT_TRUE(kRect.Within(beside).empty());
  }
  EXPECT_EQ(kRect.Within({{4, 0}, {9, 9}}), (CellRect{{4, 0}, {5, 1}}));
  EXPECT_EQ(kRect.Within(WholeRaster({0.0, 0.0, 0.1, 4, 7})), (CellRect{{2, 0}, {4, 1}}));
}

TEST(CellRectTest, GrowsOnEachSide) {
  EXPECT_EQ(kRect.Grown(2), (CellRect{{0, -3}, {7, 3}}));
  EXPECT_EQ(kRect.Grown(0), kRect);
}

TEST(CellRectTest, IncludesCells) {
  CellRect rect;
  EXPECT_TRUE(rect.empty());
  rect.Include({-3, 4});
  EXPECT_EQ(rect, (CellRect{{-3, 4}, {-2, 5}}));
  EXPECT_FALSE(rect.empty());
  rect.Include({1, 2});
  EXPECT_EQ(rect, (CellRect{{-3, 2}, {2, 5}}));
  rect.Include({0, 3});
  EXPECT_EQ(rect, (CellRect{{-3, 2}, {2, 5}}));
}

}  // namespace cell_rect_test
}  // namespace plumescout
