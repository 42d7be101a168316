// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/scene_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_scene.h"

namespace plumescout::lab {
namespace scene_world_test {

// In the small scene frame t holds 20 t + cell index counts of 0.05 ppm, every 0.5 s.
constexpr Point2 kPoint{0.0, 1.15};  // cell (2,1), index 7
double Truth_ppm(int frame) { return 0.05 * (20 * frame + 7); }

TEST(SceneWorldTest, TellsTheNearestFrame) {
  const SceneWorld world(MakeSmallScene());
  EXPECT_DOUBLE_EQ(world.Concentration_ppm(kPoint, 0.0), Truth_ppm(0));
  EXPECT_DOUBLE_EQ(world.Concentration_ppm(kPoint, 0.2), Truth_ppm(0));
  EXPECT_DOUBLE_EQ(world.Concentration_ppm(kPoint, 0.3), Truth_ppm(1));
  EXPECT_DOUBLE_EQ(world.Concentration_ppm(kPoint, 1.0), Truth_ppm(2));
}

TEST(SceneWorldTest, HoldsTheLastFrameUnlessToldToRepeat) {
  const SceneWorld world(MakeSmallScene());
  EXPECT_DOUBLE_EQ(world.Concentration_ppm(kPoint, 99.0), Truth_ppm(2));
}

TEST(SceneWorldTest, RepeatsTheFramesIfTold) {
  const SceneWorld world(MakeSmallScene(), {.series_end = SeriesEnd::kRepeat});
  EXPECT_DOUBLE_EQ(world.Concentration_ppm(kPoint, 1.2), Truth_ppm(2));
  EXPECT_DOUBLE_EQ(world.Concentration_ppm(kPoint, 1.3), Truth_ppm(0));
  EXPECT_DOUBLE_EQ(world.Concentration_ppm(kPoint, 1.5), Truth_ppm(0));
  EXPECT_DOUBLE_EQ(world.Concentration_ppm(kPoint, 2.0), Truth_ppm(1));
  EXPECT_DOUBLE_EQ(world.Concentration_ppm(kPoint, 151.0), Truth_ppm(2));
}

TEST(SceneWorldTest, CollidesWithOccupiedCells) {
  const SceneWorld world(MakeSmallScene());  // free: x in [-0.15, 0.15), y in [1.1, 1.3)
  EXPECT_FALSE(world.Collides({0.0, 1.2}, 0.09));
  EXPECT_TRUE(world.Collides({0.0, 1.2}, 0.11));  // walls 0.1 m to the south and north
  EXPECT_FALSE(world.Collides({0.0, 1.2}, 0.0));
  EXPECT_TRUE(world.Collides({-0.2, 1.2}, 0.0));  // in the western wall
}

TEST(SceneWorldTest, CollidesWithCornersByTheirDistance) {
  Scene scene = MakeSmallScene();
  const GridGeometry geometry{0.0, 0.0, 1.0, 3, 3};
  scene.occupancy = Grid<CellState>(geometry, CellState::kFree);
  scene.occupancy[Cell(2, 2)] = CellState::kOccupied;  // its corner at (2, 2)
  const SceneWorld world(scene);
  EXPECT_FALSE(world.Collides({1.4, 1.4}, 0.84));  // sqrt(0.72) = 0.8485 m away
  EXPECT_TRUE(world.Collides({1.4, 1.4}, 0.85));
}

TEST(SceneWorldTest, CollidesBeyondTheRaster) {
  const SceneWorld world(MakeSmallScene());
  EXPECT_TRUE(world.Collides({100.0, 0.0}, 0.1));
  EXPECT_TRUE(world.Collides({1e12, -1e12}, 0.1));
}

TEST(SceneWorldTest, AddsTheAmbientAirEverywhere) {
  const SceneWorld world(MakeSmallScene(), {.ambient_ppm = 400.0});
  EXPECT_DOUBLE_EQ(world.Concentration_ppm(kPoint, 0.0), 400.0 + Truth_ppm(0));
  EXPECT_EQ(world.ambient_ppm(), 400.0);
}

TEST(SceneWorldTest, RejectsAmbientAirOutOfRange) {
  EXPECT_TRUE(Validate(SceneWorldOptions{}).ok());
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_TRUE(absl::IsInvalidArgument(Validate(SceneWorldOptions{.ambient_ppm = bad})));
  }
}

}  // namespace scene_world_test
}  // namespace plumescout::lab
