// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/momentum.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/lab/sim/flow_domains.h"

namespace plumescout::lab {
namespace momentum_test {

constexpr double kCell_m = 0.1;
constexpr double kRounding = 1e-11;  // of sums of some ten terms around 10, divided by a cell

std::vector<double> RateOf(const FlowDomain& domain, const MacField& velocity, double viscosity) {
  Momentum momentum(domain, FreeFaces(domain));
  std::vector<double> rate(velocity.values().size());
  momentum.Rate(velocity, viscosity, rate);
  return rate;
}

// u = x, v = -y: -div(velocity velocity) = (-x, -y). Linear, so second order is exact.
TEST(MomentumTest, CarriesALinearFlowExactly) {
  const FlowDomain domain = ClosedRoom(8, 8);
  MacField velocity(domain.fluid.geometry());
  for (int y = 0; y <= 8; ++y) {
    for (int x = 0; x <= 8; ++x) {
      if (y < 8) velocity.u(x, y) = x * kCell_m;
      if (x < 8) velocity.v(x, y) = -y * kCell_m;
    }
  }
  const std::vector<double> rate = RateOf(domain, velocity, 1e-9);
  for (int y = 2; y <= 5; ++y) {  // two cells and more off the walls
    for (int x = 3; x <= 5; ++x) {
      EXPECT_NEAR(rate[velocity.UFace(x, y)], -x * kCell_m, 1e-7) << x << ", " << y;
      EXPECT_NEAR(rate[velocity.VFace(x, y)], -y * kCell_m, 1e-7) << x << ", " << y;
    }
  }
}

// nu d2u/dy2 of a parabola, also beside the walls: there it is 0 half a cell off the last face.
TEST(MomentumTest, RubsAtTheWallItself) {
  constexpr int kRows = 6;
  constexpr double kViscosity = 0.5;
  const FlowDomain domain = ClosedRoom(6, kRows);
  MacField velocity(domain.fluid.geometry());
  // The parabola whose mirror image at the wall continues it: y (H - y) + h^2 / 4.
  for (int y = 0; y < kRows; ++y) {
    const double at_m = (y + 0.5) * kCell_m;
    const double speed = at_m * (kRows * kCell_m - at_m) + 0.25 * kCell_m * kCell_m;
    for (int x = 0; x <= 6; ++x) velocity.u(x, y) = speed;
  }
  const std::vector<double> rate = RateOf(domain, velocity, kViscosity);
  for (int y = 0; y < kRows; ++y) {
    EXPECT_NEAR(rate[velocity.UFace(3, y)], -2.0 * kViscosity, kRounding) << y;
  }
}

// Still air under a lid: only the layer of cells below it is dragged, by nu 2 U / h^2.
TEST(MomentumTest, IsDraggedByASlidingEdge) {
  FlowDomain domain = ClosedRoom(4, 4);
  domain.edge_speeds_mps[static_cast<std::size_t>(Side::kNorth)] = 3.0;
  const MacField still(domain.fluid.geometry());
  const std::vector<double> rate = RateOf(domain, still, 0.02);
  EXPECT_NEAR(rate[still.UFace(2, 3)], 0.02 * 2.0 * 3.0 / (kCell_m * kCell_m), kRounding);
  EXPECT_EQ(rate[still.UFace(2, 2)], 0.0);
}

// A jump that the air carries eastward stays between its two levels.
TEST(MomentumTest, MakesNoNewExtremes) {
  const FlowDomain domain = ClosedRoom(20, 6);
  MacField velocity(domain.fluid.geometry());
  for (int y = 0; y <= 6; ++y) {
    for (int x = 0; x <= 20; ++x) {
      if (y < 6) velocity.u(x, y) = 1.0;
      if (x < 20) velocity.v(x, y) = x < 8 ? 0.0 : 1.0;
    }
  }
  const double step_s = 0.4 * kCell_m;
  for (int i = 0; i < 10; ++i) {
    const std::vector<double> rate = RateOf(domain, velocity, 1e-12);
    for (int x = 2; x < 18; ++x) velocity.v(x, 3) += step_s * rate[velocity.VFace(x, 3)];
    for (int x = 2; x < 18; ++x) {
      for (int y = 0; y <= 6; ++y) velocity.v(x, y) = velocity.v(x, 3);
      EXPECT_GE(velocity.v(x, 3), -kRounding);
      EXPECT_LE(velocity.v(x, 3), 1.0 + kRounding);
    }
  }
  EXPECT_LT(velocity.v(9, 3), 0.5);   // 4 cells on, the jump has passed
  EXPECT_GT(velocity.v(14, 3), 0.5);  // and has not come here
}

TEST(MomentumTest, TakesAwayHalfTheSquareOfSpeedWhereAirComesInThroughAnOutlet) {
  const FlowDomain domain = Channel(5, 3, 1.0);
  MacField velocity(domain.fluid.geometry());
  velocity.u(5, 1) = -2.0;
  const std::vector<double> rate = RateOf(domain, velocity, 0.01);
  EXPECT_NEAR(rate[velocity.UFace(5, 1)], 0.5 * 2.0 * 2.0 / kCell_m, kRounding);
}

TEST(MomentumTest, MovesFreeFacesAndOutlets) {
  FlowDomain domain = Channel(5, 3, 1.0);
  domain.fans = {{{2, 1}, Side::kWest, 2.0}};
  const Momentum momentum(domain, FreeFaces(domain));
  // 4 x 3 vertical faces less the fan's, 5 x 2 horizontal ones, 3 outlets.
  EXPECT_EQ(momentum.moving().size(), 11u + 10u + 3u);
}

}  // namespace momentum_test
}  // namespace plumescout::lab
