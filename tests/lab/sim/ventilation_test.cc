// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/ventilation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace plumescout::lab {
namespace ventilation_test {

struct Draw {
  FloorPlan plan;
  Ventilation air;
};

// What some seeds draw, as far as they draw anything.
std::vector<Draw> Draws() {
  std::vector<Draw> draws;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Rng rng(seed);
    const auto plan = DrawFloorPlan(70, 90, {900, 0.5, 0.3}, rng);
    if (!plan) continue;
    const auto air = DrawVentilation(*plan, rng);
    if (air) draws.push_back({*plan, *air});
  }
  return draws;
}

TEST(VentilationTest, MostPlansCanBeVentilated) { EXPECT_GE(Draws().size(), 40u); }

TEST(VentilationTest, WindowsLieInTheOuterWallOfTheirRoom) {
  for (const Draw& draw : Draws()) {
    for (const Window& window : draw.air.windows) {
      const CellRect& floor = draw.plan.rooms[window.room].floor;
      const CellRect& zone = window.zone;
      EXPECT_TRUE(zone.min.x >= floor.min.x && zone.end.x <= floor.end.x);
      EXPECT_TRUE(zone.min.y >= floor.min.y && zone.end.y <= floor.end.y);
      const bool outer = (window.side == Side::kWest && zone.min.x == 1) ||
                         (window.side == Side::kEast && zone.end.x == draw.plan.width - 1) ||
                         (window.side == Side::kSouth && zone.min.y == 1) ||
                         (window.side == Side::kNorth && zone.end.y == draw.plan.height - 1);
      EXPECT_TRUE(outer);
    }
  }
}

TEST(VentilationTest, AirEntersAndLeavesElsewhere) {
  for (const Draw& draw : Draws()) {
    const std::vector<Window>& windows = draw.air.windows;
    const auto is_inlet = [](const Window& window) { return window.inflow_mps.has_value(); };
    const auto inlets = std::count_if(windows.begin(), windows.end(), is_inlet);
    EXPECT_TRUE(inlets == 1 || inlets == 2);
    EXPECT_GT(windows.size(), static_cast<std::size_t>(inlets));
    for (const Window& outlet : windows) {
      if (is_inlet(outlet)) continue;
      for (const Window& inlet : windows) {
        EXPECT_FALSE(is_inlet(inlet) && inlet.room == outlet.room);
      }
    }
  }
}

TEST(VentilationTest, FlowIsThatOfAllInletsAndBounded) {
  Ventilation air;
  air.windows = {{Side::kWest, 10, 5, 2.0, 0, {}}, {Side::kEast, 10, 9, std::nullopt, 1, {}}};
  EXPECT_DOUBLE_EQ(air.Flow_m2_per_s(), 2.0);  // 2 m/s through a metre
  for (const Draw& draw : Draws()) {
    EXPECT_GT(draw.air.Flow_m2_per_s(), 0.0);
    EXPECT_LE(draw.air.Flow_m2_per_s(), 4.5 + 1e-9);
  }
}

TEST(VentilationTest, NoAirOfOtherRoomsEntersTheFreshRoom) {
  for (const Draw& draw : Draws()) {
    bool other_inlets = false;
    bool own_inlet = false;
    for (const Window& window : draw.air.windows) {
      if (!window.inflow_mps) continue;
      (window.room == draw.air.fresh_room ? own_inlet : other_inlets) = true;
    }
    EXPECT_TRUE(own_inlet);
    int doors = 0;
    for (const Partition& wall : draw.plan.partitions) {
      for (const PlanDoor& door : wall.doors) {
        for (const int room : {door.room_a, door.room_b}) {
          doors += static_cast<std::size_t>(room) == draw.air.fresh_room ? 1 : 0;
        }
      }
    }
    EXPECT_TRUE(!other_inlets || doors == 1);
  }
}

}  // namespace ventilation_test
}  // namespace plumescout::lab
