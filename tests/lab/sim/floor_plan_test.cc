// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/floor_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace plumescout::lab {
namespace floor_plan_test {

constexpr std::uint64_t kSeeds = 50;
constexpr FloorPlanStyle kOffices{400, 0.8, 0.3};

// The plan of the first draw that connects all rooms.
FloorPlan Draw(std::uint64_t seed, const FloorPlanStyle& style) {
  Rng rng(seed);
  while (true) {
    if (const auto plan = DrawFloorPlan(80, 100, style, rng)) return *plan;
  }
}

TEST(FloorPlanTest, RoomsAndPartitionsTileTheBuilding) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const FloorPlan plan = Draw(seed, kOffices);
    int area = 0;
    for (const Room& room : plan.rooms) area += AreaOf(room.floor);
    for (const Partition& wall : plan.partitions) area += AreaOf(wall.solid);
    EXPECT_EQ(area, 78 * 98) << seed;
    for (std::size_t i = 0; i < plan.rooms.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(plan.rooms[i].floor.Overlaps(plan.rooms[j].floor)) << seed;
      }
    }
  }
}

TEST(FloorPlanTest, DoorsConnectAllRooms) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const FloorPlan plan = Draw(seed, kOffices);
    std::vector<bool> reached(plan.rooms.size());
    reached[0] = true;
    for (std::size_t pass = 0; pass < plan.rooms.size(); ++pass) {
      for (const Partition& wall : plan.partitions) {
        for (const PlanDoor& door : wall.doors) {
          const auto a = static_cast<std::size_t>(door.room_a);
          const auto b = static_cast<std::size_t>(door.room_b);
          if (reached[a] || reached[b]) reached[a] = reached[b] = true;
        }
      }
    }
    EXPECT_TRUE(std::all_of(reached.begin(), reached.end(), [](bool r) { return r; })) << seed;
  }
}

TEST(FloorPlanTest, DoorsLeadFromOneRoomIntoTheOther) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const FloorPlan plan = Draw(seed, kOffices);
    for (const Partition& wall : plan.partitions) {
      for (const PlanDoor& door : wall.doors) {
        EXPECT_TRUE(door.width >= 5 && door.width <= 8) << door.width;
        for (const int index : {door.room_a, door.room_b}) {
          const CellRect& floor = plan.rooms[static_cast<std::size_t>(index)].floor;
          const int low = wall.vertical ? floor.min.y : floor.min.x;
          const int high = wall.vertical ? floor.end.y : floor.end.x;
          EXPECT_GE(door.from, low + 2) << seed;
          EXPECT_LE(door.from + door.width, high - 2) << seed;
        }
      }
    }
  }
}

TEST(FloorPlanTest, StylesMakeHallsOrCorridors) {
  int halls = 0;
  int corridors = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const Room& room : Draw(seed, {2500, 0.0, 0.3}).rooms) {
      halls += room.kind == RoomKind::kHall ? 1 : 0;
      EXPECT_NE(room.kind, RoomKind::kCorridor);
    }
    for (const Room& room : Draw(seed, kOffices).rooms) {
      corridors += room.kind == RoomKind::kCorridor ? 1 : 0;
      EXPECT_NE(room.kind, RoomKind::kHall);
    }
  }
  EXPECT_GE(halls, 50);
  EXPECT_GE(corridors, 50);
}

TEST(FloorPlanTest, IntegersCoverTheirRange) {
  Rng rng(1);
  int low = 10;
  int high = 0;
  for (int i = 0; i < 1000; ++i) {
    const int draw = DrawInt(rng, 3, 6);
    low = std::min(low, draw);
    high = std::max(high, draw);
  }
  EXPECT_EQ(low, 3);
  EXPECT_EQ(high, 6);
  EXPECT_EQ(DrawInt(rng, -2, -2), -2);
}

}  // namespace floor_plan_test
}  // namespace plumescout::lab
