// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/anchor_cell.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumescout {
namespace anchor_cell_test {

constexpr GridGeometry kAnchor{1.0, -2.0, 0.1, 4, 3};

GridGeometry Moved(double x_m, double y_m) {
  GridGeometry geometry = kAnchor;
  geometry.origin_x_m += x_m;
  geometry.origin_y_m += y_m;
  return geometry;
}

TEST(AnchorCellTest, ComesRowByRowFromTheSouth) {
  EXPECT_LT((AnchorCell{5, 0}), (AnchorCell{-5, 1}));
  EXPECT_LT((AnchorCell{0, 1}), (AnchorCell{1, 1}));
  EXPECT_EQ((AnchorCell{1, 1}), (AnchorCell{1, 1}));
}

TEST(CornerOfTest, CountsWholeCellsFromTheAnchor) {
  EXPECT_EQ(CornerOf(kAnchor, kAnchor).value(), (AnchorCell{0, 0}));
  EXPECT_EQ(CornerOf(Moved(-0.3, 0.7), kAnchor).value(), (AnchorCell{-3, 7}));
}

TEST(CornerOfTest, ForgivesTheRoundingOfLongSums) {
  GridGeometry grown = kAnchor;
  for (int k = 0; k < 100'000; ++k) grown.origin_x_m -= grown.resolution_m;
  EXPECT_EQ(CornerOf(grown, kAnchor).value(), (AnchorCell{-100'000, 0}));
}

TEST(CornerOfTest, RefusesALatticeThatDoesNotMatch) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  GridGeometry coarser = kAnchor;
  coarser.resolution_m = 0.2;
  for (const GridGeometry& geometry : {coarser, Moved(0.05, 0.0), Moved(0.0, 0.01), Moved(kNan, 0),
                                       Moved(kInfinity, 0.0), Moved(0.0, 1e300), Moved(6e7, 0.0)}) {
    EXPECT_EQ(CornerOf(geometry, kAnchor).status().code(), absl::StatusCode::kInvalidArgument);
  }
}

TEST(CornerOfTest, RefusesAnAnchorWithoutResolution) {
  GridGeometry none = kAnchor;
  none.resolution_m = 0.0;
  EXPECT_EQ(CornerOf(none, none).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace anchor_cell_test
}  // namespace plumescout
