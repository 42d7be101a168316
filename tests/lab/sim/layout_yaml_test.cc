// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/layout_yaml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "formats/file_io.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace layout_yaml_test {

using ::testing::HasSubstr;

constexpr char kShortest[] = R"(
name: room
size_m: [4, 3]
sources: [{position_m: [1, 1.5], rate_ppm_per_s: 600}]
start_pose: {x_m: 3, y_m: 0.5, yaw_rad: 1.5}
)";

void ExpectInvalid(const std::string& yaml, const std::string& message) {
  const absl::Status status = ParseLayout(yaml).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << yaml;
  EXPECT_THAT(std::string(status.message()), HasSubstr(message));
}

TEST(LayoutYamlTest, ReadsEveryKey) {
  const auto layout = ParseLayout(std::string(kShortest) + R"(
resolution_m: 0.2
border_m: 0.4
sensor_height_m: 0.3
critical_threshold_ppm: 5
walls:
  - {from_m: [2, 0], to_m: [2, 3], thickness_m: 0.4, doors: [{at_m: 1.5, width_m: 1.2}]}
boxes: [{min_m: [1, 2], max_m: [1.4, 2.4]}]
openings:
  - {side: south, from_m: 0.6, to_m: 1.4, inflow_mps: 2}
  - {side: east, from_m: 1, to_m: 2}
fans: [{position_m: [2.5, 1.5], direction_rad: -1.5, width_m: 0.6, speed_mps: 2.5}]
gas: {filaments_per_s: 50, initial_sigma_m: 0.2, growth_m2_per_s: 0.002,
      diffusivity_m2_per_s: 0.03, mixing_depth_m: 1.5}
)");
  ASSERT_TRUE(layout.ok()) << layout.status();
  EXPECT_EQ(layout->name, "room");
  EXPECT_EQ(layout->size_x_m, 4.0);
  EXPECT_EQ(layout->size_y_m, 3.0);
  EXPECT_EQ(layout->resolution_m, 0.2);
  EXPECT_EQ(layout->border_m, 0.4);
  EXPECT_EQ(layout->critical_threshold_ppm, 5.0);
  EXPECT_EQ(layout->start_pose, (Pose2{3.0, 0.5, 1.5}));
  ASSERT_EQ(layout->walls.size(), 1u);
  EXPECT_EQ(layout->walls[0].from, (Point2{2.0, 0.0}));
  EXPECT_EQ(layout->walls[0].to, (Point2{2.0, 3.0}));
  EXPECT_EQ(layout->walls[0].thickness_m, 0.4);
  ASSERT_EQ(layout->walls[0].doors.size(), 1u);
  EXPECT_EQ(layout->walls[0].doors[0].at_m, 1.5);
  EXPECT_EQ(layout->walls[0].doors[0].width_m, 1.2);
  ASSERT_EQ(layout->boxes.size(), 1u);
  EXPECT_EQ(layout->boxes[0].max, (Point2{1.4, 2.4}));
  ASSERT_EQ(layout->openings.size(), 2u);
  EXPECT_EQ(layout->openings[0].side, Side::kSouth);
  EXPECT_EQ(layout->openings[0].inflow_mps, 2.0);
  EXPECT_EQ(layout->openings[1].side, Side::kEast);
  EXPECT_FALSE(layout->openings[1].inflow_mps.has_value());
  ASSERT_EQ(layout->fans.size(), 1u);
  EXPECT_EQ(layout->fans[0].position, (Point2{2.5, 1.5}));
  EXPECT_EQ(layout->fans[0].direction_rad, -1.5);
  EXPECT_EQ(layout->fans[0].width_m, 0.6);
  EXPECT_EQ(layout->fans[0].speed_mps, 2.5);
  ASSERT_EQ(layout->sources.size(), 1u);
  EXPECT_EQ(layout->sources[0], (GasSource{0, 1.0, 1.5, 0.3, 600.0}));
  EXPECT_EQ(layout->gas.filaments_per_s, 50.0);
  EXPECT_EQ(layout->gas.initial_sigma_m, 0.2);
  EXPECT_EQ(layout->gas.growth_m2_per_s, 0.002);
  EXPECT_EQ(layout->gas.diffusivity_m2_per_s, 0.03);
  EXPECT_EQ(layout->gas.mixing_depth_m, 1.5);
}

TEST(LayoutYamlTest, ReadsSchedulesOfSources) {
  std::string text = kShortest;
  const std::string source = "rate_ppm_per_s: 600";
  text.replace(text.find(source), source.size(),
               source + ", release: {start_s: -30, end_s: 90, on_s: 5, off_s: 2.5}");
  const auto layout = ParseLayout(text);
  ASSERT_TRUE(layout.ok()) << layout.status();
  EXPECT_EQ(layout->sources[0].release, (ReleaseSchedule{-30.0, 90.0, 5.0, 2.5}));
  text.replace(text.find("end_s: 90"), 9, "end_s: -90");
  ExpectInvalid(text, "sources[0].release.end_s = -90 must be after start_s = -30");
  text.replace(text.find("end_s: -90"), 10, "stop_s: 90");
  ExpectInvalid(text, "unknown key sources[0].release.stop_s");
}

TEST(LayoutYamlTest, LeavesDefaultsWhereNothingIsSaid) {
  const auto layout = ParseLayout(kShortest);
  ASSERT_TRUE(layout.ok()) << layout.status();
  EXPECT_EQ(layout->resolution_m, Layout().resolution_m);
  EXPECT_EQ(layout->gas.mixing_depth_m, GasParameters().mixing_depth_m);
  EXPECT_TRUE(layout->openings.empty());
}

TEST(LayoutYamlTest, NamesUnknownKeysByTheirPath) {
  ExpectInvalid(std::string(kShortest) + "colour: red", "unknown key colour");
  ExpectInvalid(std::string(kShortest) +
                    "walls: [{from_m: [1, 1], to_m: [2, 1], doors: [{at_m: 1, wide: 2}]}]",
                "unknown key walls[0].doors[0].wide");
}

TEST(LayoutYamlTest, NamesMissingKeys) {
  ExpectInvalid("name: room", "missing key size_m");
  ExpectInvalid(std::string(kShortest) + "boxes: [{min_m: [1, 1]}]", "missing key boxes[0].max_m");
  ExpectInvalid(std::string(kShortest) + "fans: [{position_m: [1, 1], width_m: 1, speed_mps: 1}]",
                "missing key fans[0].direction_rad");
}

TEST(LayoutYamlTest, NamesRepeatedKeys) {
  ExpectInvalid(std::string(kShortest) + "border_m: 0.2\nborder_m: 0.3", "repeated key border_m");
}

TEST(LayoutYamlTest, NamesValuesThatAreNoNumbers) {
  ExpectInvalid(std::string(kShortest) + "border_m: .nan", "border_m = nan");
  ExpectInvalid(std::string(kShortest) + "boxes: [{min_m: [.nan, 1], max_m: [2, 2]}]",
                "boxes[0].min_m[0] = nan");
}

TEST(LayoutYamlTest, NamesMistypedKeys) {
  ExpectInvalid(std::string(kShortest) + "border_m: thick", "border_m = thick must be a number");
  ExpectInvalid(std::string(kShortest) + "boxes: 3", "boxes = 3 must be a list");
  ExpectInvalid(std::string(kShortest) + "boxes: [{min_m: [1, 1, 1], max_m: [2, 2]}]",
                "boxes[0].min_m must be two numbers [x, y]");
  ExpectInvalid(std::string(kShortest) + "openings: [{side: up, from_m: 1, to_m: 2}]",
                "openings[0].side = up must be west, east, south or north");
  ExpectInvalid(std::string(kShortest) + "gas: [1]", "gas must be a map");
}

TEST(LayoutYamlTest, RejectsValuesOutOfRange) {
  ExpectInvalid(std::string(kShortest) + "border_m: .nan", "border_m = nan");
  ExpectInvalid(std::string(kShortest) + "resolution_m: 1e9", "resolution_m = 1e+09");
}

TEST(LayoutYamlTest, RejectsWhatIsNoLayout) {
  ExpectInvalid("", "the layout must be a map");
  ExpectInvalid("[1, 2]", "the layout must be a map");
  ExpectInvalid("name: [", "line");
}

TEST(LayoutYamlTest, ReadsTheBundledScene) {
  const auto layout = ReadLayout("lab/scenes/industrial_16x20.yaml");
  ASSERT_TRUE(layout.ok()) << layout.status();
  EXPECT_EQ(layout->size_x_m, 16.0);
  EXPECT_EQ(layout->size_y_m, 20.0);
  ASSERT_EQ(layout->sources.size(), 3u);  // rates of [XIT] Table I
  EXPECT_EQ(layout->sources[0].rate_ppm_per_s, 1750.0);
  EXPECT_EQ(layout->sources[1].rate_ppm_per_s, 1250.0);
  EXPECT_EQ(layout->sources[2].rate_ppm_per_s, 1000.0);
}

TEST(LayoutYamlTest, NamesTheFileInErrors) {
  EXPECT_EQ(ReadLayout("no/such.yaml").status().code(), absl::StatusCode::kNotFound);
  const TempFolder folder;
  ASSERT_TRUE(WriteFile(folder.File("bad.yaml"), "name: [").ok());
  EXPECT_THAT(std::string(ReadLayout(folder.File("bad.yaml")).status().message()),
              HasSubstr("bad.yaml"));
}

}  // namespace layout_yaml_test
}  // namespace plumescout::lab
