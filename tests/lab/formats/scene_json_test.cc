// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/scene_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "absl/strings/str_replace.h"
#include "tests/support/small_scene.h"

namespace plumescout::lab {
namespace scene_json_test {

using testing::HasSubstr;

constexpr char kText[] = R"({"name": "D", "resolution_m": 0.1, "width": 11, "height": 12,
  "origin": [-5.5, -6], "sensor_height_m": 0.45,
  "sources": [{"id": 3, "x": 2.5, "y": -4.5, "z": 0.5, "rate_ppm_per_s": 600}],
  "start_pose": {"x": -1.0, "y": -2.1, "yaw": 3.5},
  "time_series": {"file": "ts.zst", "frames": 60, "dt_s": 0.5, "shape": [60, 12, 11],
                  "scale_ppm_per_count": 0.05},
  "wind": {"file": "wind_uv.npy"}, "critical_threshold_ppm": 2.5, "stats": {"free_cells": 1}})";

// Expects kText with `from` replaced by `to` to be refused with a message that holds `field`.
void ExpectInvalid(const std::string& from, const std::string& to, const std::string& field) {
  const std::string text = absl::StrReplaceAll(kText, {{from, to}});
  ASSERT_NE(text, kText) << from;
  const auto description = ParseSceneJson(text);
  EXPECT_EQ(description.status().code(), absl::StatusCode::kInvalidArgument) << from;
  EXPECT_THAT(std::string(description.status().message()), HasSubstr(field));
}

TEST(SceneJson, ReadsEveryField) {
  const auto description = ParseSceneJson(kText);
  ASSERT_TRUE(description.ok()) << description.status();
  const Scene& scene = description->scene;
  EXPECT_EQ(scene.name, "D");
  EXPECT_EQ(scene.geometry(), (GridGeometry{-5.5, -6, 0.1, 11, 12}));
  EXPECT_EQ(scene.sensor_height_m, 0.45);
  EXPECT_EQ(scene.sources, (std::vector<GasSource>{{3, 2.5, -4.5, 0.5, 600}}));
  EXPECT_EQ(scene.start_pose, (Pose2{-1.0, -2.1, WrapAngle_rad(3.5)}));
  EXPECT_EQ(scene.series, (ConcentrationSeries{60, 0.5, 0.05, {}}));
  EXPECT_EQ(scene.critical_threshold_ppm, 2.5);
  EXPECT_TRUE(scene.openings.empty());
  EXPECT_EQ(description->files.series, "ts.zst");
  EXPECT_EQ(description->files.wind, "wind_uv.npy");
}

TEST(SceneJson, WindMayBeAbsent) {
  const auto description =
      ParseSceneJson(absl::StrReplaceAll(kText, {{R"("wind": {"file": "wind_uv.npy"},)", ""}}));
  ASSERT_TRUE(description.ok()) << description.status();
  EXPECT_EQ(description->files.wind, std::nullopt);
}

TEST(SceneJson, WhatIsFormattedComesBackExactly) {
  Scene scene = MakeSmallScene();
  scene.start_pose = {1.0 / 3.0, -1e-300, 0.1 + 0.2};
  scene.name = "quote \" and newline \n";
  const auto description = ParseSceneJson(FormatSceneJson(scene, {"s", "w"}));
  ASSERT_TRUE(description.ok()) << description.status();
  EXPECT_EQ(description->scene.name, scene.name);
  EXPECT_EQ(description->scene.geometry(), scene.geometry());
  EXPECT_EQ(description->scene.start_pose, scene.start_pose);
  EXPECT_EQ(description->scene.sources, scene.sources);
  EXPECT_EQ(description->files.series, "s");
  EXPECT_EQ(description->files.wind, "w");
}

TEST(SceneJson, OpeningsComeBackExactly) {
  Scene scene = MakeSmallScene();
  scene.openings = {{Side::kNorth, -0.1, 0.1, 0.3}, {Side::kWest, 1.1, 1.3, std::nullopt}};
  const auto description = ParseSceneJson(FormatSceneJson(scene, {"s", "w"}));
  ASSERT_TRUE(description.ok()) << description.status();
  EXPECT_EQ(description->scene.openings, scene.openings);
}

TEST(SceneJson, BadOpeningsAreNamed) {
  const std::string before = "\"stats\":";
  const auto with = [&before](const std::string& openings) {
    return "\"openings\": " + openings + ", " + before;
  };
  ExpectInvalid(before, with("7"), "openings = 7 must be a list");
  ExpectInvalid(before, with("[{\"from_m\": 1, \"to_m\": 2}]"), "openings[0].side is missing");
  ExpectInvalid(before, with("[{\"side\": \"up\", \"from_m\": 1, \"to_m\": 2}]"),
                "openings[0].side = up");
  ExpectInvalid(before, with("[{\"side\": \"west\", \"from_m\": 1}]"),
                "openings[0].to_m is missing");
}

TEST(SceneJson, SchedulesOfSourcesSurviveARoundTrip) {
  Scene scene = MakeSmallScene();
  scene.sources.resize(3);
  scene.sources[1].release = {-30.0, 60.5, 10.0, 20.0};
  scene.sources[2].release.end_s = 7.0;
  const auto description = ParseSceneJson(FormatSceneJson(scene, {"s", {}}));
  ASSERT_TRUE(description.ok()) << description.status();
  EXPECT_EQ(description->scene.sources, scene.sources);
}

TEST(SceneJson, BadSchedulesAreNamed) {
  const auto expect_invalid = [](const std::string& release, const std::string& message) {
    ExpectInvalid("\"rate_ppm_per_s\"", "\"release\": " + release + ", \"rate_ppm_per_s\"",
                  "sources[0].release" + message);
  };
  expect_invalid("{\"end_s\": \"soon\"}", ".end_s = \"soon\" must be a number");
  expect_invalid("{\"start_s\": 5, \"end_s\": 4}", ".end_s = 4 must be after start_s = 5");
}

TEST(SceneJson, ANameThatIsNoUtf8IsStillWritten) {
  Scene scene = MakeSmallScene();
  scene.name = "\xFF\xFE";
  EXPECT_TRUE(ParseSceneJson(FormatSceneJson(scene, {"s", {}})).ok());
}

TEST(SceneJson, TextThatIsNoJsonIsDataLoss) {
  const std::string deep(100'000, '[');
  for (const std::string& text : {std::string(), std::string("{"), std::string("\xFF"), deep,
                                  std::string(kText).substr(0, 200)}) {
    EXPECT_EQ(ParseSceneJson(text).status().code(), absl::StatusCode::kDataLoss);
  }
}

TEST(SceneJson, MissingFieldsAreNamed) {
  ExpectInvalid("\"name\"", "\"nom\"", "name is missing");
  ExpectInvalid("\"yaw\"", "\"heading\"", "start_pose.yaw is missing");
  ExpectInvalid("\"rate_ppm_per_s\"", "\"rate\"", "sources[0].rate_ppm_per_s is missing");
  ExpectInvalid("[-5.5, -6]", "[-5.5]", "origin[1] is missing");
  ExpectInvalid(kText, "[]", "name is missing");
  ExpectInvalid(kText, "7", "name is missing");
}

TEST(SceneJson, FieldsOfAnotherTypeAreNamed) {
  ExpectInvalid("\"D\"", "4", "name = 4 must be a text");
  ExpectInvalid("0.1,", "\"0.1\",", "resolution_m = \"0.1\" must be a number");
  ExpectInvalid("0.1,", "null,", "resolution_m = null must be a number");
  ExpectInvalid("\"width\": 11", "\"width\": 11.5", "width = 11.5 must be a whole number");
  ExpectInvalid("\"sources\": [", "\"sources\": 1, \"s\": [", "sources = 1 must be a list");
  ExpectInvalid("{\"file\": \"wind_uv.npy\"}", "{\"file\": {}}", "wind.file must be a text");
}

TEST(SceneJson, ValuesOutOfRangeAreNamed) {
  ExpectInvalid("\"width\": 11", "\"width\": 0", "width = 0");
  ExpectInvalid("\"width\": 11", "\"width\": 8193", "width");
  ExpectInvalid("\"width\": 11", "\"width\": 18446744073709551615", "width");
  ExpectInvalid("-5.5", "1e10", "origin[0] = 10000000000.0 must be");
  ExpectInvalid("\"frames\": 60", "\"frames\": 1000001", "frames");
  ExpectInvalid("[60, 12, 11]", "[60, 11, 12]", "time_series.shape[1]");
}

TEST(SceneJson, FilesOfOtherFoldersAreRefused) {
  ExpectInvalid("ts.zst", "../ts.zst", "time_series.file");
  ExpectInvalid("ts.zst", "/etc/passwd", "time_series.file");
  ExpectInvalid("wind_uv.npy", "..", "wind.file");
}

}  // namespace scene_json_test
}  // namespace plumescout::lab
