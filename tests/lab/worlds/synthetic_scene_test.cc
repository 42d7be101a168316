// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/synthetic_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/plan/cost/edge_cost.h"

namespace plumescout::lab {
namespace synthetic_scene_test {

// A room of 4 m x 3 m with a box in its west and a cloud in its east.
SceneSpec SmallRoom() {
  SceneSpec spec;
  spec.name = "Small";
  spec.width_m = 4.0;
  spec.height_m = 3.0;
  spec.obstacles = {{{0.5, 1.0}, {1.0, 1.5}}};
  spec.clouds = {{{3.05, 1.55}, 20.0, 0.4}};
  spec.start = {1.55, 1.55};
  spec.goal = {3.55, 1.55};
  return spec;
}

std::vector<SceneSpec> AllScenes() {
  std::vector<SceneSpec> specs = ConvergenceScenes();
  specs.push_back(DistanceWeightScene());
  return specs;
}

TEST(SyntheticScene, GoalsCanBeReached) {
  for (const SceneSpec& spec : AllScenes()) {
    const SyntheticScene scene = BuildScene(spec);
    EXPECT_EQ(scene.reachable[scene.goal.cell], 1) << spec.name;
    EXPECT_EQ(scene.reachable[scene.occupancy.geometry().CellAt(scene.start)], 1) << spec.name;
  }
}

TEST(SyntheticScene, NoStraightWayIsFree) {
  for (const SceneSpec& spec : AllScenes()) {
    const SyntheticScene scene = BuildScene(spec);
    EXPECT_TRUE(std::isinf(
        SegmentIntegral_cells(scene.information.penalty, scene.start, scene.goal.position)))
        << spec.name;
  }
}

TEST(SyntheticScene, InformationIsTheGas) {
  const SyntheticScene scene = BuildScene(SmallRoom());
  const GridGeometry& geometry = scene.occupancy.geometry();
  EXPECT_FALSE(scene.information.flat);
  EXPECT_NEAR(scene.information.value[geometry.CellAt({3.05, 1.55})], 1.0, 1e-3);
  EXPECT_NEAR(scene.information.value[geometry.CellAt({1.55, 1.55})], 0.0, 1e-2);
}

TEST(SyntheticScene, ObstaclesAndWallsKeepTheRobotAtADistance) {
  const SyntheticScene scene = BuildScene(SmallRoom());
  const GridGeometry& geometry = scene.occupancy.geometry();
  EXPECT_EQ(scene.occupancy[geometry.CellAt({0.75, 1.25})], CellState::kOccupied);
  EXPECT_EQ(scene.occupancy[geometry.CellAt({0.05, 1.25})], CellState::kOccupied);
  EXPECT_EQ(scene.occupancy[geometry.CellAt({1.15, 1.25})], CellState::kFree);
  EXPECT_EQ(scene.reachable[geometry.CellAt({1.15, 1.25})], 0);  // within the inflation
  EXPECT_EQ(scene.reachable[geometry.CellAt({1.35, 1.25})], 1);
}

TEST(SyntheticScene, MeansAreOverTheLengthOfThePath) {
  SyntheticScene scene = BuildScene(SmallRoom());
  for (std::size_t i = 0; i < scene.information.value.size(); ++i) {
    const Cell cell = scene.occupancy.geometry().CellAtIndex(i);
    scene.information.value[i] = cell.x < 20 ? 0.25F : 0.75F;
  }
  const std::vector<Point2> path = {{1.0, 2.05}, {2.0, 2.05}, {2.5, 2.05}};
  EXPECT_DOUBLE_EQ(PathLength_m(path), 1.5);
  EXPECT_NEAR(MeanInformation(scene, path), (1.0 * 0.25 + 0.5 * 0.75) / 1.5, 1e-6);
}

TEST(SyntheticScene, PointsAlongAPathKeepItsVerticesAndAreAtMostAStepApart) {
  const std::vector<Point2> path = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.05}};
  const std::vector<Point2> points = PointsAlong(path, 0.3);
  ASSERT_EQ(points.size(), 6u);
  EXPECT_EQ(points.front(), path.front());
  EXPECT_EQ(points[4], path[1]);
  EXPECT_EQ(points.back(), path.back());
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_LE(Distance_m(points[i - 1], points[i]), 0.3);
  }
}

TEST(SyntheticScene, PanelsShowThePathsAddedToThem) {
  MapPanel panel = MakeScenePanel(BuildScene(SmallRoom()));
  EXPECT_EQ(panel.title, "Small");
  EXPECT_EQ(panel.marks.size(), 2u);
  const std::vector<Point2> path = {{1.0, 1.0}, {2.0, 2.0}};
  AddPath(path, {{}, 3.0}, panel);
  ASSERT_EQ(panel.lines.size(), 2u);  // the rim and the line
  EXPECT_EQ(panel.lines.back().points, path);
  EXPECT_GT(panel.lines.front().stroke.width_px, panel.lines.back().stroke.width_px);
}

}  // namespace synthetic_scene_test
}  // namespace plumescout::lab
