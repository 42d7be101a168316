// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/linalg/room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace plumescout {
namespace room_test {

TEST(Room, KeepsItsMemoryForAsMuchOrLess) {
  Room room;
  double* const values = room.For(8);
  std::fill_n(values, 8, 3.0);
  EXPECT_EQ(room.For(8), values);
  EXPECT_EQ(room.For(2), values);
  EXPECT_EQ(room.data(), values);
  EXPECT_EQ(values[7], 3.0);
}

TEST(Room, HasPlaceForMore) {
  Room room;
  room.For(2);
  double* const values = room.For(1000);
  std::fill_n(values, 1000, 1.0);
  EXPECT_EQ(std::count(room.data(), room.data() + 1000, 1.0), 1000);
}

TEST(Room, MovesWithoutItsNumbersMoving) {
  Room room;
  double* const values = room.For(4);
  const Room moved = std::move(room);
  EXPECT_EQ(moved.data(), values);
}

TEST(Room, ForNothingIsNone) {
  Room room;
  EXPECT_EQ(room.For(0), nullptr);
}

}  // namespace room_test
}  // namespace plumescout
