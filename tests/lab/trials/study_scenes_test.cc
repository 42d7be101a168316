// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/study_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "lab/formats/scene_folder.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace study_scenes_test {

using ::testing::ElementsAre;

ExperimentOptions QuickIn(const TempFolder& folder) {
  ExperimentOptions options;
  options.quick = true;
  options.folder = folder.path();
  return options;
}

TEST(StudyScenes, AreThoseThatAreGiven) {
  ExperimentOptions options;
  options.scenes = {"a", "b"};
  EXPECT_THAT(HallScene(options, 10.0).value(), ElementsAre("a", "b"));
  EXPECT_THAT(GeneratedScenes(options, {1, 5}, 10.0).value(), ElementsAre("a", "b"));
}

TEST(StudyScenes, NeedAFolder) {
  const absl::Status status = HallScene({}, 10.0).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
}

TEST(StudyScenes, AreMadeOnceWithGasForTheTimeAsked) {
  const TempFolder folder;
  const auto scenes = GeneratedScenes(QuickIn(folder), {5, 1}, 4.0);
  ASSERT_TRUE(scenes.ok()) << scenes.status();
  ASSERT_THAT(*scenes, ElementsAre(folder.File("scenes/building_5_quick")));
  const auto scene = ReadScene(scenes->front());
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->series.frames, 8);  // 4 s at 2 Hz
  const auto made = std::filesystem::last_write_time(scenes->front() + "/scene.json");
  ASSERT_TRUE(GeneratedScenes(QuickIn(folder), {5, 1}, 4.0).ok());
  EXPECT_EQ(std::filesystem::last_write_time(scenes->front() + "/scene.json"), made);
}

}  // namespace study_scenes_test
}  // namespace plumescout::lab
