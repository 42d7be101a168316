// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/layout_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "lab/sim/layout_generator.h"
#include "lab/sim/layout_yaml.h"
#include "tests/lab/sim/small_layout.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace layout_writer_test {

void ExpectSameBack(const Layout& layout) {
  const auto read = ParseLayout(FormatLayout(layout));
  ASSERT_TRUE(read.ok()) << read.status() << "\n" << FormatLayout(layout);
  EXPECT_EQ(*read, layout) << FormatLayout(layout);
}

TEST(LayoutWriterTest, WritesLayoutsThatReadBackTheSame) {
  ExpectSameBack(SmallLayout());
  for (std::uint64_t seed = 0; seed < 20; ++seed) ExpectSameBack(GenerateLayout(seed));
  const auto bundled = ReadLayout("lab/scenes/industrial_16x20.yaml");
  ASSERT_TRUE(bundled.ok()) << bundled.status();
  ExpectSameBack(*bundled);
}

TEST(LayoutWriterTest, WritesEveryField) {
  Layout layout = SmallLayout();
  layout.name = "a \"name\": with #, \\ and \n";
  layout.resolution_m = 1.0 / 30.0;
  layout.border_m = 0.3;
  layout.sensor_height_m = 0.1 + 0.2;
  layout.sources[0].z_m = layout.sensor_height_m;
  layout.critical_threshold_ppm = 1e-7;
  layout.walls = {{{0.5, 2.5}, {3.5, 2.5}, 0.15, {{0.7, 0.6}, {2.1, 0.8}}}};
  layout.fans = {{{1.0, 0.9}, -0.7, 0.4, 2.5}, {{3.0, 1.5}, 1.0, 0.6, 0.1}};
  layout.sources.push_back({1, 3.0, 1.0, layout.sensor_height_m, 750.0, {-30.0, 60.5, 10.0, 20.0}});
  layout.sources.push_back(
      {2, 3.0, 1.5, layout.sensor_height_m, 1e-3, {std::nullopt, 7.0, std::nullopt, std::nullopt}});
  layout.start_pose.yaw_rad = -3.0;
  layout.gas = {50.0, 0.2, 0.001, 0.03, 1.5};
  ExpectSameBack(layout);
}

TEST(LayoutWriterTest, RefusesAnInvalidLayout) {
  const TempFolder folder;
  Layout layout = SmallLayout();
  layout.sources.clear();
  EXPECT_EQ(WriteLayout(layout, folder.File("l.yaml")).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_FALSE(std::filesystem::exists(folder.File("l.yaml")));
}

}  // namespace layout_writer_test
}  // namespace plumescout::lab
