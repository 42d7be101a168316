// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/one_lane_layout.h"

#include <gtest/gtest.h>

#include "core/grid/distance_field.h"
#include "core/grid/flood.h"
#include "lab/sim/layout_raster.h"

namespace plumescout::lab {
namespace one_lane_layout_test {

// Cells that the middle of a robot can be in that keeps 0.2 m off walls.
Grid<std::uint8_t> Traversable(const Grid<CellState>& occupancy) {
  Grid<std::uint8_t> occupied(occupancy.geometry());
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = occupancy[i] == CellState::kOccupied ? 1 : 0;
  }
  const Grid<std::int32_t> distance_cells2 = SquaredDistances_cells2(occupied);
  Grid<std::uint8_t> traversable(occupancy.geometry());
  for (std::size_t i = 0; i < traversable.size(); ++i) {
    traversable[i] = distance_cells2[i] > 4 ? 1 : 0;
  }
  return traversable;
}

TEST(OneLaneLayout, EveryRoomIsReachedByLanesForOne) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Layout layout = OneLaneLayout(seed);
    ASSERT_TRUE(Validate(layout).ok()) << Validate(layout);
    const auto raster = Rasterize(layout);
    ASSERT_TRUE(raster.ok()) << raster.status();
    const Grid<std::uint8_t> open = Traversable(raster->occupancy);
    const Cell start = open.geometry().CellAt(layout.start_pose.position());
    EXPECT_EQ(open[start], 1);
    EXPECT_EQ(ReachableCells(open, {start}, Connectivity::kFour), open) << seed;
    // Across the corridor, in its middle.
    const int x = open.width() / 2;
    int across = 0;
    for (int y = open.height() / 2 - 4; y < open.height() / 2 + 4; ++y) {
      across += open[Cell{x, y}];
    }
    EXPECT_GE(across, 2);
    EXPECT_LE(across, 8);
  }
}

TEST(OneLaneLayout, DependsOnTheSeedAlone) {
  EXPECT_EQ(OneLaneLayout(3), OneLaneLayout(3));
  EXPECT_FALSE(OneLaneLayout(3) == OneLaneLayout(4));
}

}  // namespace one_lane_layout_test
}  // namespace plumescout::lab
