// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/field_window.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace field_window_test {

// The map has grown by two columns to the west and by one row to the south since.
const GridGeometry kField{0.0, 0.0, 0.1, 3, 2};
const GridGeometry kMap{-0.2, -0.1, 0.1, 6, 4};

TEST(FieldWindow, CellsOfTheMapAreThoseOfTheFieldOrNone) {
  const FieldWindow window(kMap, kField);
  EXPECT_EQ(window.InField({2, 1}), (Cell{0, 0}));
  EXPECT_EQ(window.InField({4, 2}), (Cell{2, 1}));
  EXPECT_FALSE(window.InField({1, 1}).has_value());
  EXPECT_FALSE(window.InField({2, 0}).has_value());
  EXPECT_FALSE(window.InField({5, 1}).has_value());
  EXPECT_FALSE(window.InField({2, 3}).has_value());
}

TEST(FieldWindow, RectanglesOfTheFieldLieOnTheMapToo) {
  const CellRect whole = FieldWindow(kMap, kField).InMap(WholeRaster(kField));
  EXPECT_EQ(whole, CellRect({2, 1}, {5, 3}));
}

}  // namespace field_window_test
}  // namespace plumescout
