// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/stop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/support/counting_stop.h"

namespace plumescout {
namespace stop_test {

using testing::CountingStop;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Stops, IsFalseOfNoStop) {
  EXPECT_FALSE(Stops({}));
  EXPECT_FALSE(Stops(NeverStop()));
}

TEST(InPieces, VisitsEveryCellOnceAndAsksBeforeEachPiece) {
  std::vector<int> visits(2 * kCellsPerStop + 5, 0);
  CountingStop stop;
  EXPECT_TRUE(InPieces(visits.size(), stop.Fn(), [&](std::size_t first, std::size_t end) {
    EXPECT_LE(end - first, kCellsPerStop);
    for (std::size_t i = first; i < end; ++i) ++visits[i];
  }));
  EXPECT_THAT(visits, Each(1));
  EXPECT_EQ(stop.asked(), 3);
}

TEST(InPieces, LeavesOutTheRestOnceToldTo) {
  CountingStop stop(1);
  std::vector<std::size_t> ends;
  EXPECT_FALSE(InPieces(3 * kCellsPerStop, stop.Fn(),
                        [&](std::size_t, std::size_t end) { ends.push_back(end); }));
  EXPECT_THAT(ends, ElementsAre(kCellsPerStop));
  EXPECT_TRUE(InPieces(0, stop.Fn(), [](std::size_t, std::size_t) { FAIL(); }));
}

TEST(ByRows, AsksOnceInSoManyRowsAsThePieceHolds) {
  std::vector<int> rows;
  CountingStop stop;
  const int width = static_cast<int>(kCellsPerStop) / 4;
  EXPECT_TRUE(ByRows(3, 12, width, stop.Fn(), [&](int y) { rows.push_back(y); }));
  EXPECT_THAT(rows, ElementsAre(3, 4, 5, 6, 7, 8, 9, 10, 11));
  EXPECT_EQ(stop.asked(), 3);
}

TEST(ByRows, AsksAtEachRowThatIsLongerThanAPiece) {
  std::vector<int> rows;
  CountingStop stop(2);
  const int width = 3 * static_cast<int>(kCellsPerStop);
  EXPECT_FALSE(ByRows(0, 9, width, stop.Fn(), [&](int y) { rows.push_back(y); }));
  EXPECT_THAT(rows, ElementsAre(0, 1));
  rows.clear();
  EXPECT_TRUE(ByRows(5, 5, 0, {}, [&](int y) { rows.push_back(y); }));
  EXPECT_THAT(rows, IsEmpty());
}

}  // namespace stop_test
}  // namespace plumescout
