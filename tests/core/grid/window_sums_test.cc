// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/window_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/types/rng.h"

namespace plumescout {
namespace window_sums_test {

Grid<float> RandomValues(const GridGeometry& geometry, Rng& rng) {
  Grid<float> values(geometry);
  for (float& value : values.values()) value = static_cast<float>(rng.Uniform(-1.0, 2.0));
  return values;
}

double SlowSum(const Grid<float>& values, Cell middle, int reach_cells) {
  double sum = 0.0;
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      const bool inside =
          std::abs(x - middle.x) <= reach_cells && std::abs(y - middle.y) <= reach_cells;
      if (inside) sum += static_cast<double>(values[Cell{x, y}]);
    }
  }
  return sum;
}

TEST(WindowSums, AreThoseOfALoopOverTheWindow) {
  Rng rng(7);
  for (const int reach_cells : {0, 1, 4, 11, 15, 30}) {
    const Grid<float> values = RandomValues({-1.3, 2.7, 0.1, 23, 17}, rng);
    const Grid<float> sums = WindowSums(values, reach_cells);
    ASSERT_EQ(sums.geometry(), values.geometry());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const Cell cell = sums.geometry().CellAtIndex(i);
      const double slow = SlowSum(values, cell, reach_cells);
      // One rounding to single precision; the table's own is some 1e-13.
      EXPECT_NEAR(static_cast<double>(sums[i]), slow, 1e-7 * std::abs(slow) + 1e-12);
    }
  }
}

TEST(WindowSums, OfNoReachAreTheValues) {
  Rng rng(3);
  const Grid<float> values = RandomValues({0.0, 0.0, 0.1, 5, 4}, rng);
  const Grid<float> sums = WindowSums(values, 0);
  for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_NEAR(sums[i], values[i], 1e-6);
}

TEST(WindowSums, OfAnEmptyRasterAreEmpty) { EXPECT_EQ(WindowSums(Grid<float>(), 3).size(), 0u); }

TEST(WindowSums, StayExactOverAWideRaster) {
  const Grid<float> values({0.0, 0.0, 0.1, 3000, 4}, 0.3F);
  const Grid<float> sums = WindowSums(values, 1);
  // 12000 cells in the table before the difference is taken: double precision loses nothing.
  EXPECT_NEAR(static_cast<double>(sums[Cell{2998, 2}]), 9.0 * static_cast<double>(0.3F), 1e-6);
}

}  // namespace window_sums_test
}  // namespace plumescout
