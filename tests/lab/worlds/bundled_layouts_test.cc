// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/bundled_layouts.h"

#include <gtest/gtest.h>

#include "lab/sim/layout_raster.h"
#include "lab/sim/layout_yaml.h"

namespace plumescout::lab {
namespace bundled_layouts_test {

TEST(BundledLayouts, AreLayoutsThatCanBeBuilt) {
  for (const char* name : {"co2_trial", "industrial_16x20"}) {
    const auto layout = BundledLayout(name);
    ASSERT_TRUE(layout.ok()) << layout.status();
    EXPECT_EQ(layout->name, name);
    EXPECT_TRUE(Rasterize(*layout).ok()) << Rasterize(*layout).status();
  }
}

TEST(BundledLayouts, TheTrialsArenaIsAsThePaperSays) {
  const Layout arena = *BundledLayout("co2_trial");
  EXPECT_NEAR(arena.size_x_m - 2.0 * arena.border_m, 5.0, 1e-9);
  EXPECT_NEAR(arena.size_y_m - 2.0 * arena.border_m, 3.7, 1e-9);
  ASSERT_EQ(arena.sources.size(), 2u);
  const double middle_m = arena.size_x_m / 2.0;
  EXPECT_LT(arena.sources[0].x_m, middle_m);
  EXPECT_GT(arena.sources[1].x_m, middle_m);
  ASSERT_EQ(arena.fans.size(), 3u);
  EXPECT_LT(arena.fans[0].position.x_m, middle_m);
  EXPECT_LT(arena.fans[1].position.x_m, middle_m);
  EXPECT_GT(arena.fans[2].position.x_m, middle_m);
  EXPECT_LT(arena.fans[2].speed_mps, arena.fans[0].speed_mps);
  EXPECT_LT(arena.fans[2].speed_mps, arena.fans[1].speed_mps);
}

// A wall thinner than a cell that lies between two rows of cell centres is none.
TEST(BundledLayouts, TheTrialsInnerBarriersAreThere) {
  const Layout arena = *BundledLayout("co2_trial");
  const LayoutRaster raster = *Rasterize(arena);
  for (const Wall& wall : arena.walls) {
    const Point2 middle{(wall.from.x_m + wall.to.x_m) / 2.0, (wall.from.y_m + wall.to.y_m) / 2.0};
    const Cell cell = raster.occupancy.geometry().CellAt(middle);
    EXPECT_EQ(raster.occupancy[cell], CellState::kOccupied) << middle.x_m << ", " << middle.y_m;
  }
}

TEST(BundledLayouts, AreThoseOfTheirFiles) {
  const auto bundled = BundledLayout("industrial_16x20");
  ASSERT_TRUE(bundled.ok()) << bundled.status();
  const auto file = ReadLayout("lab/scenes/industrial_16x20.yaml");
  ASSERT_TRUE(file.ok()) << file.status();
  EXPECT_EQ(bundled->name, file->name);
  EXPECT_EQ(bundled->sources, file->sources);
  EXPECT_EQ(bundled->walls.size(), file->walls.size());
}

TEST(BundledLayouts, OthersAreNotFound) {
  const absl::Status status = BundledLayout("no_such_hall").status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_NE(status.message().find("no_such_hall"), std::string::npos);
}

}  // namespace bundled_layouts_test
}  // namespace plumescout::lab
