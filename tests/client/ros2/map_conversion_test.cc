// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/map_conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumescout::client {
namespace map_conversion_test {

using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::NanSensitiveFloatEq;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr GridGeometry kGeometry = {-1.0, 2.0, 0.5, 3, 2};

Grid<float> Layer(std::vector<float> values) {
  Grid<float> layer(kGeometry);
  layer.values() = std::move(values);
  return layer;
}

// The robot's origin lies at (-1, 2) of the mission, and its x axis points north.
ViewPoint Turned() { return {{{7, 8}, "map"}, {.mission_from_robot = {-1.0, 2.0, M_PI_2}}}; }

TEST(ToOccupancyGrid, LiesWhereTheRobotsFrameHasIt) {
  Grid<CellState> cells(kGeometry);
  cells[Cell{1, 0}] = CellState::kFree;
  cells[Cell{2, 1}] = CellState::kOccupied;
  const ros::OccupancyGrid grid = ToOccupancyGrid(cells, Turned());
  EXPECT_EQ(grid.header.frame_id, "map");
  EXPECT_EQ(grid.header.stamp.sec, 7);
  EXPECT_EQ(grid.info.width, 3u);
  EXPECT_EQ(grid.info.height, 2u);
  EXPECT_EQ(grid.info.resolution, 0.5F);
  EXPECT_NEAR(grid.info.origin.position.x, 0.0, 1e-12);
  EXPECT_NEAR(grid.info.origin.position.y, 0.0, 1e-12);
  EXPECT_NEAR(grid.info.origin.orientation.z, -std::sqrt(0.5), 1e-12);
  EXPECT_THAT(grid.data, ElementsAre(-1, 0, -1, -1, -1, 100));
}

TEST(ToScaledGrid, CutsWhatIsBeyondTheScale) {
  const Grid<float> layer = Layer({0.0F, 1.0F, 4.0F, kNan, 9.0F, -1.0F});
  EXPECT_THAT(ToScaledGrid(layer, 4.0F, {}).data, ElementsAre(0, 25, 100, -1, 100, 0));
  EXPECT_EQ(TopOf(layer), 9.0F);
  EXPECT_EQ(TopOf(Layer({kNan, 0.0F, -2.0F, kNan, 0.0F, 0.0F})), 1.0F);
}

TEST(ToGridMap, BeginsAtTheFarCornerAndGoesColumnByColumn) {
  MapSnapshot map;
  map.gas_mean_ppm = Layer({0.0F, 1.0F, 2.0F, 3.0F, 4.0F, kNan});
  map.gas_variance_ppm2 = Layer({0.0F, 0.1F, 0.2F, 0.3F, 0.4F, 0.5F});
  map.further_gases = {{"methane", map.gas_mean_ppm, map.gas_variance_ppm2}};
  const ros::GridMap message = ToGridMap(map, {});
  EXPECT_THAT(message.layers, ElementsAre("gas_mean_ppm", "gas_variance_ppm2",
                                          "gas_mean_ppm_methane", "gas_variance_ppm2_methane"));
  EXPECT_EQ(message.info.length_x, 1.5);
  EXPECT_EQ(message.info.length_y, 1.0);
  EXPECT_EQ(message.info.pose.position.x, -0.25);
  EXPECT_EQ(message.info.pose.position.y, 2.5);
  // Rows count against x, columns against y: element (row, column) is at column * rows + row.
  ASSERT_EQ(message.data.size(), 4u);
  const ros::Float32MultiArray& mean = message.data.front();
  EXPECT_EQ(mean.dim[0].label, "column_index");
  EXPECT_EQ(mean.dim[0].size, 2u);
  EXPECT_EQ(mean.dim[0].stride, 6u);
  EXPECT_EQ(mean.dim[1].label, "row_index");
  EXPECT_EQ(mean.dim[1].size, 3u);
  EXPECT_THAT(mean.data, ElementsAre(NanSensitiveFloatEq(kNan), FloatEq(4.0F), FloatEq(3.0F),
                                     FloatEq(2.0F), FloatEq(1.0F), FloatEq(0.0F)));
}

}  // namespace map_conversion_test
}  // namespace plumescout::client
