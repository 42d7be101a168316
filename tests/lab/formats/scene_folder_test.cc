// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/scene_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "absl/strings/str_replace.h"
#include "formats/file_io.h"
#include "lab/formats/npy.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace scene_folder_test {

using testing::HasSubstr;

constexpr std::uint64_t kNoLimit = 1 << 20;

class SceneFolder : public testing::Test {
 protected:
  SceneFolder() { EXPECT_TRUE(WriteScene(scene_, path_).ok()); }

  void Replace(const std::string& file, const std::string& from, const std::string& to) {
    const std::string text = *ReadFile(path_ + "/" + file, kNoLimit);
    ASSERT_TRUE(WriteFile(path_ + "/" + file, absl::StrReplaceAll(text, {{from, to}})).ok());
  }
  void ExpectError(absl::StatusCode code, const std::string& message) {
    const auto scene = ReadScene(path_);
    EXPECT_EQ(scene.status().code(), code) << scene.status();
    EXPECT_THAT(std::string(scene.status().message()), HasSubstr(message));
  }

  const TempFolder folder_;
  const std::string path_ = folder_.File("scenes/small");
  const Scene scene_ = MakeSmallScene();
};

TEST_F(SceneFolder, WhatIsWrittenComesBackExactly) {
  const auto read = ReadScene(path_);
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_EQ(read->name, scene_.name);
  EXPECT_EQ(read->sensor_height_m, scene_.sensor_height_m);
  EXPECT_EQ(read->occupancy, scene_.occupancy);
  EXPECT_EQ(read->conc_mean_ppm, scene_.conc_mean_ppm);
  EXPECT_EQ(read->conc_std_ppm, scene_.conc_std_ppm);
  EXPECT_EQ(read->conc_mean_by_source_ppm, scene_.conc_mean_by_source_ppm);
  EXPECT_EQ(read->series, scene_.series);
  EXPECT_EQ(read->wind, scene_.wind);
  EXPECT_EQ(read->sources, scene_.sources);
  EXPECT_EQ(read->openings, scene_.openings);
  EXPECT_EQ(read->start_pose, scene_.start_pose);
  EXPECT_EQ(read->critical_threshold_ppm, scene_.critical_threshold_ppm);
}

TEST_F(SceneFolder, WindMayBeAbsent) {
  Scene scene = scene_;
  scene.wind.reset();
  const std::string path = folder_.File("calm");
  ASSERT_TRUE(WriteScene(scene, path).ok());
  EXPECT_FALSE(std::filesystem::exists(path + "/wind_uv.npy"));
  const auto read = ReadScene(path);
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_EQ(read->wind, std::nullopt);
}

TEST_F(SceneFolder, WindIsStoredWithItsComponentsInterleaved) {
  const auto wind = ReadNpy(path_ + "/wind_uv.npy");
  ASSERT_TRUE(wind.ok()) << wind.status();
  EXPECT_EQ(wind->shape, (std::vector<std::size_t>{4, 5, 2}));
  const std::size_t cell = 2 * 5 + 3;
  EXPECT_EQ(wind->values[2 * cell], scene_.wind->u_mps[cell]);
  EXPECT_EQ(wind->values[2 * cell + 1], scene_.wind->v_mps[cell]);
}

TEST_F(SceneFolder, EveryMissingFileIsNamed) {
  for (const char* file : {"scene.json", "map.pgm", "map.yaml", "conc_mean.npy", "conc_std.npy",
                           "conc_mean_by_source.npy", "conc_ts.u16.zst", "wind_uv.npy"}) {
    const std::string bytes = *ReadFile(path_ + "/" + file, kNoLimit);
    std::filesystem::remove(path_ + "/" + file);
    ExpectError(absl::StatusCode::kNotFound, file);
    ASSERT_TRUE(WriteFile(path_ + "/" + file, bytes).ok());
  }
}

TEST_F(SceneFolder, EveryTruncatedFileIsNamed) {
  for (const char* file : {"scene.json", "map.pgm", "conc_mean.npy", "conc_std.npy",
                           "conc_mean_by_source.npy", "conc_ts.u16.zst", "wind_uv.npy"}) {
    const std::string bytes = *ReadFile(path_ + "/" + file, kNoLimit);
    ASSERT_TRUE(WriteFile(path_ + "/" + file, bytes.substr(0, bytes.size() - 3)).ok());
    ExpectError(absl::StatusCode::kDataLoss, file);
    ASSERT_TRUE(WriteFile(path_ + "/" + file, bytes).ok());
  }
}

TEST_F(SceneFolder, AMapThatDoesNotFitIsNamed) {
  Replace("map.yaml", "-0.25", "-0.26");
  ExpectError(absl::StatusCode::kInvalidArgument,
              "map.yaml shows 5 x 4 cells of 0.1 m from (-0.26, 1), by scene.json it must be 5 x 4 "
              "cells of 0.1 m from (-0.25, 1)");
}

TEST_F(SceneFolder, ARasterOfAnotherShapeIsNamed) {
  const std::vector<std::size_t> shape = {5, 4};
  ASSERT_TRUE(WriteNpy(path_ + "/conc_std.npy", shape, std::vector<float>(20)).ok());
  ExpectError(absl::StatusCode::kInvalidArgument,
              "conc_std.npy: the shape is [5, 4], by scene.json it must be [4, 5]");
}

TEST_F(SceneFolder, ASeriesOfAnotherLengthIsNamed) {
  Replace("scene.json", "\"frames\": 3", "\"frames\": 4");
  Replace("scene.json", "   3,", "   4,");
  ExpectError(absl::StatusCode::kDataLoss,
              "conc_ts.u16.zst: the zstd frame holds 120 bytes, expected 160");
}

TEST_F(SceneFolder, ASeriesThatIsLongerThanSaidIsNamed) {
  Replace("scene.json", "\"frames\": 3", "\"frames\": 2");
  Replace("scene.json", "   3,", "   2,");
  ExpectError(absl::StatusCode::kDataLoss,
              "conc_ts.u16.zst: the zstd frame holds 120 bytes, expected 80");
}

TEST_F(SceneFolder, ValuesThatAreNotFiniteOrNegativeAreNamed) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const struct {
    const char* file;
    std::vector<std::size_t> shape;
    float value;
    const char* message;
  } cases[] = {
      {"conc_mean.npy", {4, 5}, kNan, "conc_mean.npy: the value at [1, 2] is nan"},
      {"conc_std.npy", {4, 5}, -0.5F, "conc_std.npy: the value at [1, 2] is -0.5"},
      {"conc_mean_by_source.npy", {2, 4, 5}, -1.0F, "by_source.npy: the value at [0, 1, 2] is -1"},
      {"wind_uv.npy", {4, 5, 2}, kNan, "wind_uv.npy: the value at [0, 3, 1] is nan"}};
  for (const auto& bad : cases) {
    const std::string bytes = *ReadFile(path_ + "/" + bad.file, kNoLimit);
    std::size_t size = 1;
    for (const std::size_t side : bad.shape) size *= side;
    std::vector<float> values(size);
    values[7] = bad.value;
    ASSERT_TRUE(WriteNpy(path_ + "/" + bad.file, bad.shape, values).ok());
    ExpectError(absl::StatusCode::kInvalidArgument, bad.message);
    ASSERT_TRUE(WriteFile(path_ + "/" + bad.file, bytes).ok());
  }
}

TEST_F(SceneFolder, ASeriesTooLargeIsRefusedBeforeItIsUnpacked) {
  Replace("scene.json", "\"frames\": 3", "\"frames\": 100000000");
  ExpectError(absl::StatusCode::kInvalidArgument, "time_series.frames");
}

TEST_F(SceneFolder, AnInvalidSceneIsNeitherReadNorWritten) {
  Replace("scene.json", "1.15,", "100.0,");
  ExpectError(absl::StatusCode::kInvalidArgument, "start_pose");
  Scene scene = scene_;
  scene.sources.clear();
  const std::string path = folder_.File("invalid");
  EXPECT_EQ(WriteScene(scene, path).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace scene_folder_test
}  // namespace plumescout::lab
