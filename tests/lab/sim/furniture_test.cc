// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/furniture.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

namespace plumescout::lab {
namespace furniture_test {

constexpr std::uint64_t kSeeds = 50;

FloorPlan OneRoom(RoomKind kind, int width, int height) {
  FloorPlan plan;
  plan.width = width + 2;
  plan.height = height + 2;
  plan.rooms = {{{{1, 1}, {width + 1, height + 1}}, kind}};
  return plan;
}

TEST(FurnitureTest, LeavesAPassageOrTouches) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const RoomKind kind : {RoomKind::kRoom, RoomKind::kHall, RoomKind::kCorridor}) {
      const FloorPlan plan = OneRoom(kind, 50, 40);
      const CellRect& floor = plan.rooms[0].floor;
      Rng rng(seed);
      const std::vector<CellRect> pieces = DrawFurniture(plan, {}, rng);
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (const int gap : {pieces[i].min.x - floor.min.x, pieces[i].min.y - floor.min.y,
                              floor.end.x - pieces[i].end.x, floor.end.y - pieces[i].end.y}) {
          EXPECT_TRUE(gap == 0 || gap >= kPassage_units) << seed << ": " << gap;
        }
        for (std::size_t j = 0; j < i; ++j) {
          EXPECT_FALSE(pieces[i].Grown(kPassage_units).Overlaps(pieces[j])) << seed;
        }
      }
    }
  }
}

TEST(FurnitureTest, KeepsOutOfTheWay) {
  const FloorPlan plan = OneRoom(RoomKind::kHall, 60, 60);
  const std::vector<CellRect> clear = {{{1, 20}, {15, 30}}, {{30, 1}, {40, 61}}};
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Rng rng(seed);
    for (const CellRect& piece : DrawFurniture(plan, clear, rng)) {
      for (const CellRect& zone : clear) EXPECT_FALSE(piece.Overlaps(zone)) << seed;
    }
  }
}

TEST(FurnitureTest, HallsAreFurnishedInSeveralWays) {
  const FloorPlan plan = OneRoom(RoomKind::kHall, 60, 60);
  std::set<std::size_t> counts;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Rng rng(seed);
    const std::size_t count = DrawFurniture(plan, {}, rng).size();
    EXPECT_GE(count, 3u) << seed;
    counts.insert(count);
  }
  EXPECT_GE(counts.size(), 4u);
}

TEST(FurnitureTest, NarrowCorridorsStayEmpty) {
  const FloorPlan plan = OneRoom(RoomKind::kCorridor, 80, 9);
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Rng rng(seed);
    EXPECT_TRUE(DrawFurniture(plan, {}, rng).empty()) << seed;
  }
}

}  // namespace furniture_test
}  // namespace plumescout::lab
