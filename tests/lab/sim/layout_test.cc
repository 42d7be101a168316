// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/lab/sim/small_layout.h"

namespace plumescout::lab {
namespace layout_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

void ExpectInvalid(const Layout& layout, const std::string& message) {
  const absl::Status status = Validate(layout);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), StartsWith(message));
}

TEST(LayoutTest, AcceptsASoundLayout) { EXPECT_TRUE(Validate(SmallLayout()).ok()); }

TEST(LayoutTest, NamesTheFieldTheValueAndTheRange) {
  Layout layout = SmallLayout();
  layout.walls.resize(3, {{1.0, 1.0}, {2.0, 1.0}, 0.2, {}});
  layout.walls[2].thickness_m = 0.0;
  ExpectInvalid(layout, "walls[2].thickness_m = 0 must be in (0, 10]");
}

TEST(LayoutTest, RejectsNumbersThatAreNone) {
  Layout layout = SmallLayout();
  layout.sources[0].rate_ppm_per_s = std::nan("");
  ExpectInvalid(layout, "sources[0].rate_ppm_per_s = nan");
  layout = SmallLayout();
  layout.size_x_m = INFINITY;
  ExpectInvalid(layout, "size_m[0] = inf");
  layout = SmallLayout();
  layout.start_pose.yaw_rad = std::nan("");
  ExpectInvalid(layout, "start_pose.yaw_rad = nan");
}

TEST(LayoutTest, RejectsTooManyCells) {
  Layout layout = SmallLayout();
  layout.size_x_m = 200.0;
  layout.size_y_m = 200.0;
  layout.resolution_m = 0.1;
  ExpectInvalid(layout, "cells = 4e+06");
}

TEST(LayoutTest, RejectsPartsOutsideTheBuilding) {
  Layout layout = SmallLayout();
  layout.boxes[0].max.x_m = 4.5;
  ExpectInvalid(layout, "boxes[0].max_m[0] = 4.5");
  layout = SmallLayout();
  layout.openings[1].to_m = 2.95;  // runs into the corner
  ExpectInvalid(layout, "openings[1].to_m = 2.95");
}

TEST(LayoutTest, RejectsBoxesAndOpeningsTurnedInsideOut) {
  Layout layout = SmallLayout();
  layout.boxes[0].max = layout.boxes[0].min;
  ExpectInvalid(layout, "boxes[0].min_m must be less than max_m");
  layout = SmallLayout();
  layout.openings[0].to_m = layout.openings[0].from_m;
  ExpectInvalid(layout, "openings[0].to_m");
}

TEST(LayoutTest, RejectsDoorsBeyondTheWall) {
  Layout layout = SmallLayout();
  layout.walls = {{{1.0, 1.0}, {2.0, 1.0}, 0.2, {{1.5, 0.4}}}};
  ExpectInvalid(layout, "walls[0].doors[0].at_m = 1.5 must be in [0.2, 0.8]");
  layout.walls[0].doors[0] = {0.9, 0.4};  // runs over the end
  ExpectInvalid(layout, "walls[0].doors[0].at_m = 0.9 must be in [0.2, 0.8]");
  layout.walls[0].doors[0] = {0.5, 1.2};
  ExpectInvalid(layout, "walls[0].doors[0].width_m = 1.2 must be in (0, 1]");
  layout.walls[0].doors[0] = {std::nan(""), 0.4};
  ExpectInvalid(layout, "walls[0].doors[0].at_m = nan");
}

TEST(LayoutTest, RejectsDoorsThatOverlap) {
  Layout layout = SmallLayout();
  layout.walls = {{{1.0, 1.0}, {3.0, 1.0}, 0.2, {{0.5, 0.4}, {0.8, 0.4}}}};
  ExpectInvalid(layout, "walls[0].doors[1].at_m = 0.8 overlaps doors[0]");
  layout.walls[0].doors[1].at_m = 0.9;  // touches
  EXPECT_TRUE(Validate(layout).ok());
}

TEST(LayoutTest, RejectsBoxesThatOverlap) {
  Layout layout = SmallLayout();
  layout.boxes = {{{0.5, 0.5}, {1.0, 1.0}}, {{2.0, 2.0}, {2.5, 2.5}}, {{0.9, 0.9}, {1.2, 1.2}}};
  ExpectInvalid(layout, "boxes[2] from (0.9, 0.9) overlaps boxes[0]");
  layout.boxes[2] = {{1.0, 0.5}, {1.2, 1.0}};  // touches
  EXPECT_TRUE(Validate(layout).ok());
}

TEST(LayoutTest, RejectsABuildingWithoutSourcesOrName) {
  Layout layout = SmallLayout();
  layout.sources.clear();
  ExpectInvalid(layout, "sources must not be empty");
  layout = SmallLayout();
  layout.name.clear();
  ExpectInvalid(layout, "name must not be empty");
}

TEST(LayoutTest, ChecksFans) {
  const Fan sound{{1.0, 1.0}, 0.5, 0.4, 2.0};
  Layout layout = SmallLayout();
  layout.fans = {sound};
  EXPECT_TRUE(Validate(layout).ok());
  layout.fans = {sound, sound};
  layout.fans[1].width_m = 0.0;
  ExpectInvalid(layout, "fans[1].width_m = 0 must be in (0, 200]");
  layout.fans[1] = sound;
  layout.fans[1].speed_mps = 31.0;
  ExpectInvalid(layout, "fans[1].speed_mps = 31 must be in (0, 30]");
  layout.fans[1] = sound;
  layout.fans[1].direction_rad = std::nan("");
  ExpectInvalid(layout, "fans[1].direction_rad = nan");
  layout.fans[1] = sound;
  layout.fans[1].position.y_m = 3.5;
  ExpectInvalid(layout, "fans[1].position_m[1] = 3.5");
}

TEST(LayoutTest, ChecksTheGas) {
  Layout layout = SmallLayout();
  layout.gas.mixing_depth_m = -1.0;
  ExpectInvalid(layout, "gas.mixing_depth_m = -1");
}

}  // namespace layout_test
}  // namespace plumescout::lab
