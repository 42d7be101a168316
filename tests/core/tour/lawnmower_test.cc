// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/tour/lawnmower.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace plumescout {
namespace lawnmower_test {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<Cell> Order(const Sweep& sweep) {
  const absl::StatusOr<std::vector<Cell>> order = LawnmowerOrder(sweep);
  EXPECT_TRUE(order.ok()) << order.status();
  return order.value_or(std::vector<Cell>());
}

TEST(Lawnmower, LegsTurnAround) {
  EXPECT_THAT(Order({3, 2}),
              ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{2, 0}, Cell{2, 1}, Cell{1, 1}, Cell{0, 1}));
}

TEST(Lawnmower, LegsMayGoNorth) {
  EXPECT_THAT(Order({2, 3, SweepAxis::kY}),
              ElementsAre(Cell{0, 0}, Cell{0, 1}, Cell{0, 2}, Cell{1, 2}, Cell{1, 1}, Cell{1, 0}));
}

TEST(Lawnmower, ASweepBeginsAtItsCorner) {
  const auto first_and_second = [](SweepCorner corner) {
    const std::vector<Cell> order = Order({4, 3, SweepAxis::kX, corner});
    return std::vector<Cell>(order.begin(), order.begin() + 2);
  };
  EXPECT_THAT(first_and_second(SweepCorner::kSouthWest), ElementsAre(Cell{0, 0}, Cell{1, 0}));
  EXPECT_THAT(first_and_second(SweepCorner::kSouthEast), ElementsAre(Cell{3, 0}, Cell{2, 0}));
  EXPECT_THAT(first_and_second(SweepCorner::kNorthWest), ElementsAre(Cell{0, 2}, Cell{1, 2}));
  EXPECT_THAT(first_and_second(SweepCorner::kNorthEast), ElementsAre(Cell{3, 2}, Cell{2, 2}));
}

TEST(Lawnmower, EveryPointIsAStopOnceAndStepsAreOfOne) {
  for (const SweepAxis legs : {SweepAxis::kX, SweepAxis::kY}) {
    for (const SweepCorner begin : {SweepCorner::kSouthWest, SweepCorner::kSouthEast,
                                    SweepCorner::kNorthWest, SweepCorner::kNorthEast}) {
      const std::vector<Cell> order = Order({7, 4, legs, begin});
      EXPECT_EQ(order.size(), 28U);
      EXPECT_EQ(std::set<Cell>(order.begin(), order.end()).size(), 28U);
      for (std::size_t i = 1; i < order.size(); ++i) {
        EXPECT_EQ(std::abs(order[i].x - order[i - 1].x) + std::abs(order[i].y - order[i - 1].y), 1);
      }
    }
  }
}

TEST(Lawnmower, StridesAreCountedFromTheCorner) {
  EXPECT_THAT(Order({6, 4, SweepAxis::kX, SweepCorner::kSouthWest, 2, 3}),
              ElementsAre(Cell{0, 0}, Cell{2, 0}, Cell{4, 0}, Cell{4, 3}, Cell{2, 3}, Cell{0, 3}));
  EXPECT_THAT(Order({6, 4, SweepAxis::kX, SweepCorner::kNorthEast, 2, 3}),
              ElementsAre(Cell{5, 3}, Cell{3, 3}, Cell{1, 3}, Cell{1, 0}, Cell{3, 0}, Cell{5, 0}));
  EXPECT_THAT(Order({6, 4, SweepAxis::kY, SweepCorner::kSouthWest, 3, 5}),
              ElementsAre(Cell{0, 0}, Cell{0, 3}, Cell{5, 3}, Cell{5, 0}));
}

TEST(Lawnmower, AStrideBeyondTheLatticeLeavesTheCorner) {
  constexpr int kHuge = std::numeric_limits<int>::max();
  EXPECT_THAT(Order({9, 9, SweepAxis::kX, SweepCorner::kNorthEast, kHuge, kHuge}),
              ElementsAre(Cell{8, 8}));
}

TEST(Lawnmower, ALatticeOrStrideOfNothingIsRefused) {
  const auto refusal = [](const Sweep& sweep) {
    const absl::Status status = LawnmowerOrder(sweep).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    return std::string(status.message());
  };
  EXPECT_THAT(refusal({.width = 0, .height = 3}), HasSubstr("width = 0"));
  EXPECT_THAT(refusal({.width = 3, .height = -1}), HasSubstr("height = -1"));
  EXPECT_THAT(refusal({.width = 3, .height = 3, .point_stride = 0}), HasSubstr("point_stride = 0"));
  EXPECT_THAT(refusal({.width = 3, .height = 3, .leg_stride = -2}), HasSubstr("leg_stride = -2"));
}

}  // namespace lawnmower_test
}  // namespace plumescout
