// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/scene_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "lab/report/palette.h"
#include "tests/support/small_scene.h"

namespace plumescout::lab {
namespace scene_sheet_test {

std::vector<std::string> Titles(const Scene& scene) {
  std::vector<std::string> titles;
  for (const MapPanel& panel : MakeScenePanels(scene)) titles.push_back(panel.title);
  return titles;
}

TEST(SceneSheetTest, ShowsMapWindAndGas) {
  EXPECT_EQ(Titles(MakeSmallScene()),
            (std::vector<std::string>{"Map", "Wind, 0.45 m above the floor", "Gas, mean of 2 s"}));
}

TEST(SceneSheetTest, LeavesOutAWindThatIsNotKnown) {
  Scene scene = MakeSmallScene();
  scene.wind.reset();
  EXPECT_EQ(Titles(scene), (std::vector<std::string>{"Map", "Gas, mean of 2 s"}));
}

TEST(SceneSheetTest, MarksSourcesStartAndOpenings) {
  const Scene scene = MakeSmallScene();
  const MapPanel map = MakeScenePanels(scene)[0];
  ASSERT_EQ(map.marks.size(), 3u);
  EXPECT_EQ(map.marks[0].label, "1");
  EXPECT_EQ(map.marks[1].label, "2");
  EXPECT_EQ(map.marks[1].position, (Point2{0.1, 1.15}));
  EXPECT_EQ(map.marks[2].position, scene.start_pose.position());
  ASSERT_EQ(map.lines.size(), 3u);  // two openings and where the robot looks
  EXPECT_EQ(map.lines[0].points.front().y_m, 1.1);
  EXPECT_EQ(map.lines[1].points.back().y_m, 1.3);
  EXPECT_NE(map.lines[0].stroke.color, map.lines[1].stroke.color);  // inlet and outlet
  EXPECT_EQ(map.legend.size(), 4u);
}

// The gas is x + y / 10 ppm in columns 1 to 3 of two rows: with 2.5 ppm critical the line runs
// between columns 2 and 3.
TEST(SceneSheetTest, OutlinesTheCriticalCells) {
  Scene scene = MakeSmallScene();
  scene.openings.clear();
  const MapPanel gas = MakeScenePanels(scene).back();
  ASSERT_EQ(gas.lines.size(), 2u);
  for (const MapLine& edge : gas.lines) {
    for (const Point2& end : edge.points) EXPECT_NEAR(end.x_m, 0.05, 1e-12);
  }
}

// Wind arrows point where the air goes: west in the small scene, and more and more north.
TEST(SceneSheetTest, ArrowsPointDownwind) {
  Scene scene = MakeSmallScene();
  scene.openings.clear();
  const MapPanel wind = MakeScenePanels(scene)[1];
  ASSERT_EQ(wind.lines.size(), 6u);  // one in each free cell
  for (const MapLine& arrow : wind.lines) {
    EXPECT_LT(arrow.points[1].x_m, arrow.points[0].x_m);
    EXPECT_GT(arrow.points[1].y_m, arrow.points[0].y_m);
  }
}

TEST(SceneSheetTest, DrawsScenesWithoutGasOrAir) {
  Scene scene = MakeSmallScene();
  const GridGeometry geometry = scene.geometry();
  scene.conc_mean_ppm = Grid<float>(geometry);
  scene.wind = WindField{Grid<float>(geometry), Grid<float>(geometry)};
  const Image image = DrawSceneSheet(scene);
  EXPECT_GT(image.width(), 1000);
  const bool drawn = std::any_of(image.pixels().begin(), image.pixels().end(),
                                 [](const Rgb& pixel) { return pixel == kOccupiedColor; });
  EXPECT_TRUE(drawn);
}

}  // namespace scene_sheet_test
}  // namespace plumescout::lab
