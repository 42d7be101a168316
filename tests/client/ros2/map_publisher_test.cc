// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/map_publisher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/ros/view_messages.h"
#include "tests/client/ros2/listening_node.h"

namespace plumescout::client {
namespace map_publisher_test {

using ::testing::ElementsAre;

// Who comes later hears all of the last map.
TEST(MapPublisher, LatchesMapsAndFrontiers) {
  const GridGeometry geometry{0.0, 0.0, 1.0, 2, 1};
  MapSnapshot map;
  map.occupancy = Grid<CellState>(geometry, CellState::kFree);
  map.gas_mean_ppm = Grid<float>(geometry, 2.0F);
  map.gas_mean_ppm[Cell{1, 0}] = 5.0F;
  map.gas_variance_ppm2 = Grid<float>(geometry, 0.5F);
  map.frontiers.emplace_back().cells = {{1, 0}};
  const auto node = OpenNode();
  const auto publisher =
      MapPublisher::Advertise(*node, {.topics = {.ros_namespace = "r"}, .gas_scale_ppm = 10.0});
  ASSERT_TRUE(publisher.ok()) << publisher.status();
  ASSERT_TRUE((*publisher)->Publish(map, 9'000'000'000).ok());

  const auto viewer = OpenNode();
  std::optional<ros::OccupancyGrid> occupancy;
  std::optional<ros::OccupancyGrid> mean;
  std::optional<ros::OccupancyGrid> variance;
  std::optional<ros::GridMap> gas;
  std::optional<ros::MarkerArray> frontiers;
  Keep(*viewer, "/r/map", Delivery::kLatched, occupancy);
  Keep(*viewer, "/r/gas_mean", Delivery::kLatched, mean);
  Keep(*viewer, "/r/gas_variance", Delivery::kLatched, variance);
  Keep(*viewer, "/r/gas_map", Delivery::kLatched, gas);
  Keep(*viewer, "/r/frontiers", Delivery::kLatched, frontiers);
  ASSERT_TRUE(Await(
      *viewer, [] {}, [&] { return occupancy && mean && variance && gas && frontiers; }));
  EXPECT_THAT(occupancy->data, ElementsAre(0, 0));
  EXPECT_EQ(occupancy->header.stamp.sec, 9);
  EXPECT_THAT(mean->data, ElementsAre(20, 50));
  EXPECT_THAT(variance->data, ElementsAre(100, 100));
  EXPECT_THAT(gas->data.front().data, ElementsAre(5.0F, 2.0F));
  EXPECT_EQ(frontiers->markers.size(), 2u);
}

}  // namespace map_publisher_test
}  // namespace plumescout::client
