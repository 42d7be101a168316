// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/open_air.h"

#include <gtest/gtest.h>

#include "lab/sim/gas_space.h"

namespace plumescout::lab {
namespace open_air_test {

TEST(OpenAirTest, IsInsideEverywhereAndOutsideBeyond) {
  GridGeometry geometry;
  geometry.width = 7;
  geometry.height = 4;
  const Grid<GasSpace> spaces = GasSpaces(OpenAir(geometry));
  for (const GasSpace space : spaces.values()) EXPECT_EQ(space, GasSpace::kInside);
  EXPECT_EQ(spaces.geometry(), geometry);
}

TEST(OpenAirTest, UniformWindIsTheSameAtEveryPointAndFlowsThrough) {
  GridGeometry geometry;
  geometry.width = 7;
  geometry.height = 4;
  const MacField wind = UniformWind(geometry, {1.5, -0.5});
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    const Velocity velocity = wind.AtCenter(geometry.CellAtIndex(i));
    EXPECT_EQ(velocity.u_mps, 1.5);
    EXPECT_EQ(velocity.v_mps, -0.5);
    EXPECT_EQ(wind.NetOutflow_mps(geometry.CellAtIndex(i)), 0.0);
  }
}

}  // namespace open_air_test
}  // namespace plumescout::lab
