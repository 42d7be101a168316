// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/mit_pictures.h"

#include <gtest/gtest.h>

namespace plumescout::lab {
namespace mit_pictures_test {

TEST(MitPictures, ShowTheSceneWithItsGoals) {
  const MitScene scene = *BuildMitScene(MitTableScene());
  const MapPanel panel = MitScenePanel(scene, "scene");
  EXPECT_EQ(panel.title, "scene");
  EXPECT_EQ(panel.marks.size(), 4u);  // start and three goals
  EXPECT_EQ(panel.lines.size(), 1u);  // the way that was driven
  EXPECT_EQ(panel.legend.size(), 3u);
}

TEST(MitPictures, NameTheTrajectoriesThatWereFound) {
  const MitScene scene = *BuildMitScene(MitTableScene());
  MitRun run;
  run.paths[1] = {scene.start, scene.goals[1].position};
  const MapPanel plain = MitRunsPanel(scene, {run, run}, "runs", false);
  ASSERT_EQ(plain.legend.size(), 1u);
  EXPECT_EQ(plain.legend.front().name, "trajectory 2");
  const MapPanel discs = MitRunsPanel(scene, {run, run}, "runs", true);
  EXPECT_EQ(discs.lines.size(), plain.lines.size() + 3);
}

}  // namespace mit_pictures_test
}  // namespace plumescout::lab
