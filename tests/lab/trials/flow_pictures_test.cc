// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/flow_pictures.h"

#include <gtest/gtest.h>

#include "lab/report/palette.h"

namespace plumescout::lab {
namespace flow_pictures_test {

// Eastward, faster and faster to the north: 1, 2, 3 m/s.
FlowDomain Rows() {
  FlowDomain domain;
  GridGeometry geometry;
  geometry.width = 4;
  geometry.height = 3;
  domain.fluid = Grid<std::uint8_t>(geometry, 1);
  return domain;
}
MacField Sheared() {
  MacField velocity(Rows().fluid.geometry());
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x <= 4; ++x) velocity.u(x, y) = y + 1.0;
  }
  return velocity;
}

TEST(FlowPicturesTest, CountsTheFlowFromTheCorner) {
  const MacField velocity = Sheared();
  const std::vector<double> stream = StreamFunction(velocity);
  EXPECT_NEAR(stream[velocity.UFace(0, 1)], 0.1, 1e-15);
  EXPECT_NEAR(stream[velocity.UFace(4, 2)], 0.3, 1e-15);
  EXPECT_NEAR(stream[velocity.UFace(2, 3)], 0.6, 1e-15);
}

TEST(FlowPicturesTest, TurnsTheSignForNorthwardFlow) {
  MacField velocity(Rows().fluid.geometry());
  for (int x = 0; x < 4; ++x) velocity.v(x, 0) = 2.0;
  EXPECT_NEAR(StreamFunction(velocity)[velocity.UFace(3, 0)], -0.6, 1e-15);
}

// 0.2 is half way up the second row, in all four columns.
TEST(FlowPicturesTest, DrawsStreamLinesThroughEveryCellOnTheirWay) {
  const FlowDomain domain = Rows();
  const MapPanel panel =
      DrawFlow(domain, Sheared(), {"rows", RegionOf(domain.fluid.geometry()), 3.0, {0.2}});
  ASSERT_EQ(panel.lines.size(), 4u);
  for (const MapLine& line : panel.lines) {
    for (const Point2& point : line.points) EXPECT_NEAR(point.y_m, 0.15, 1e-12);
  }
}

TEST(FlowPicturesTest, PaintsWallsGreyAndAirByItsSpeed) {
  FlowDomain domain = Rows();
  domain.fluid[Cell(0, 2)] = 0;
  const MapPanel panel =
      DrawFlow(domain, Sheared(), {"rows", RegionOf(domain.fluid.geometry()), 3.0, {}});
  EXPECT_EQ(panel.cells.image.At(0, 0), kWallColor);
  EXPECT_EQ(panel.cells.image.At(1, 0), ColorAt(ColorMap::kGas, 1.0));
  EXPECT_EQ(panel.cells.image.At(0, 2), ColorAt(ColorMap::kGas, 1.0 / 3.0));
}

}  // namespace flow_pictures_test
}  // namespace plumescout::lab
