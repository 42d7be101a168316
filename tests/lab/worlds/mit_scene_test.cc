// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/mit_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace plumescout::lab {
namespace mit_scene_test {

using ::testing::HasSubstr;

std::vector<MitSceneSpec> AllSpecs() {
  std::vector<MitSceneSpec> specs = MitSceneVariants();
  specs.push_back(MitTableScene());
  specs.push_back(MitPassageScene());
  return specs;
}

TEST(MitScene, EveryVariantCanBeBuiltAndHasItsOwnName) {
  std::set<std::string> names;
  for (const MitSceneSpec& spec : AllSpecs()) {
    EXPECT_TRUE(BuildMitScene(spec).ok()) << spec.name;
    EXPECT_TRUE(names.insert(spec.name).second) << spec.name;
  }
  EXPECT_GE(names.size(), 13u);
}

TEST(MitScene, TheInformativeFrontierIsNotTheNearest) {
  const MitScene scene = *BuildMitScene(MitTableScene());
  EXPECT_LT(Distance_m(scene.start, scene.goals[0].position),
            Distance_m(scene.start, scene.goals[2].position));
}

TEST(MitScene, ThePlumeFadesDownwindAndTheSourceIsItsPeak) {
  const MitSceneSpec spec = MitTableScene();
  const MitScene scene = *BuildMitScene(spec);
  const auto gas_ppm = [&](double east_m, double north_m) {
    const Point2 at{spec.plume.source.x_m + east_m, spec.plume.source.y_m + north_m};
    return scene.true_gas_ppm[scene.true_gas_ppm.geometry().CellAt(at)];
  };
  EXPECT_GT(gas_ppm(0.0, 0.0), gas_ppm(2.0, 0.0));
  EXPECT_GT(gas_ppm(2.0, 0.0), gas_ppm(5.0, 0.0));
  EXPECT_GT(gas_ppm(2.0, 0.0), 2.0F * gas_ppm(2.0, 1.5));
  EXPECT_GT(gas_ppm(2.0, 0.0), 10.0F * gas_ppm(-2.0, 0.0));
}

// Where the robot has read clean air both mean and variance are low; nobody has been in the east.
TEST(MitScene, WhatWasReadAndCleanIsTheLeastInformative) {
  const MitScene scene = *BuildMitScene(MitTableScene());
  const Grid<float>& information = scene.information.value;
  EXPECT_LT(information[information.geometry().CellAt({2.6, 6.6})], 0.2F);
  EXPECT_GT(information[scene.goals[1].cell], 0.4F);
}

TEST(MitScene, TheVarianceAsPrintedMakesAnotherField) {
  MitSceneSpec spec = MitTableScene();
  const MitScene ours = *BuildMitScene(spec);
  spec.raw_variance = true;
  EXPECT_NE(BuildMitScene(spec)->information.value, ours.information.value);
}

// Of draws from Eq. (2) that share is even: where I is flat all of them, where it is 0 somewhere
// none. With the whole drive read, and as printed, it lies between.
TEST(MitScene, DrawsOfTheUcbAreEvenInPart) {
  for (const MitSceneSpec& spec : AllSpecs()) {
    const MitScene scene = *BuildMitScene(spec);
    EXPECT_GT(scene.ucb_uniform_share, 0.0) << spec.name;
    EXPECT_LT(scene.ucb_uniform_share, 0.9) << spec.name;
  }
}

// The passage is 0.8 m wide: 0.4 m of it can be driven, and the way through it is the shorter one.
TEST(MitScene, ThePassageIsAShortcutThatEvenSamplesSeldomHit) {
  const MitSceneSpec spec = MitPassageScene();
  const MitScene scene = *BuildMitScene(spec);
  double passage_cells = 0.0;
  double cells = 0.0;
  for (std::size_t i = 0; i < scene.reachable.size(); ++i) {
    if (scene.reachable[i] == 0) continue;
    const Point2 at = scene.reachable.geometry().Center(scene.reachable.geometry().CellAtIndex(i));
    cells += 1.0;
    if (at.x_m > 6.0 && at.x_m < 16.0 && at.y_m < 4.0) passage_cells += 1.0;
  }
  EXPECT_GT(passage_cells, 0.0);
  EXPECT_LT(passage_cells / cells, 0.06);
  for (const Point2 at : spec.passage) {
    EXPECT_NE(scene.reachable.At(scene.reachable.geometry().CellAt(at), 0), 0)
        << at.x_m << ", " << at.y_m;
  }
}

TEST(MitScene, AGoalWithoutAWayIsRefusedByName) {
  MitSceneSpec spec = MitTableScene();
  for (const Point2 out : {Point2{0.05, 0.05}, Point2{-3.0, 4.0}, Point2{1e9, 1e9}}) {
    spec.goals[1] = out;
    const absl::Status status = BuildMitScene(spec).status();
    EXPECT_TRUE(absl::IsInvalidArgument(status));
    EXPECT_THAT(std::string(status.message()), HasSubstr(spec.name));
  }
}

}  // namespace mit_scene_test
}  // namespace plumescout::lab
