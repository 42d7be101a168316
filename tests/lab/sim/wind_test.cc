// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/wind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lab/sim/layout_raster.h"
#include "tests/lab/sim/small_layout.h"

namespace plumescout::lab {
namespace {

// What the direct solver leaves of a divergence of order 1 m/s: rounding times the condition of a
// Poisson matrix of some 1000 cells (about 1e3), with room.
constexpr double kSolverTolerance_mps = 1e-10;

FlowDomain SmallDomain() { return Rasterize(SmallLayout())->flow; }

WindOptions ShortFlow() {
  WindOptions options;
  options.flow_s = 4.0;
  return options;
}

MacField SolveOrDie(const FlowDomain& domain, const WindOptions& options) {
  const auto field = SolveWind(domain, options);
  EXPECT_TRUE(field.ok()) << field.status();
  return field.ok() ? *field : MacField(domain.fluid.geometry());
}

// A straight channel of `rows` fluid cells between two walls.
FlowDomain Channel(int length, int rows, double inflow_mps) {
  FlowDomain domain;
  GridGeometry geometry;
  geometry.width = length;
  geometry.height = rows + 2;
  domain.fluid = Grid<std::uint8_t>(geometry);
  for (int y = 1; y <= rows; ++y) {
    for (int x = 0; x < length; ++x) domain.fluid[Cell{x, y}] = 1;
    domain.openings.push_back({{0, y}, Side::kWest, inflow_mps});
    domain.openings.push_back({{length - 1, y}, Side::kEast, std::nullopt});
  }
  return domain;
}

TEST(WindTest, HasNoNetFlowIntoAnyFluidCell) {
  const FlowDomain domain = SmallDomain();
  const MacField wind = SolveOrDie(domain, ShortFlow());
  double fastest_mps = 0.0;
  for (std::size_t i = 0; i < domain.fluid.size(); ++i) {
    if (domain.fluid[i] == 0) continue;
    const Cell cell = domain.fluid.geometry().CellAtIndex(i);
    EXPECT_NEAR(wind.NetOutflow_mps(cell), 0.0, kSolverTolerance_mps) << cell.x << ", " << cell.y;
    fastest_mps =
        std::max(fastest_mps, std::hypot(wind.AtCenter(cell).u_mps, wind.AtCenter(cell).v_mps));
  }
  EXPECT_GT(fastest_mps, 0.5);
}

TEST(WindTest, DoesNotBlowThroughWalls) {
  const FlowDomain domain = SmallDomain();
  const MacField wind = SolveOrDie(domain, ShortFlow());
  const auto fluid = [&](int x, int y) { return domain.fluid.At({x, y}, 0) != 0; };
  for (int y = 0; y < domain.fluid.height(); ++y) {
    for (int x = 1; x < domain.fluid.width(); ++x) {
      if (!fluid(x - 1, y) || !fluid(x, y)) {
        EXPECT_EQ(wind.u(x, y), 0.0);
      }
    }
  }
  for (int y = 1; y < domain.fluid.height(); ++y) {
    for (int x = 0; x < domain.fluid.width(); ++x) {
      if (!fluid(x, y - 1) || !fluid(x, y)) {
        EXPECT_EQ(wind.v(x, y), 0.0);
      }
    }
  }
}

TEST(WindTest, LetsAsMuchAirOutAsItBlowsIn) {
  const FlowDomain domain = SmallDomain();
  const MacField wind = SolveOrDie(domain, ShortFlow());
  double in_mps = 0.0;
  double out_mps = 0.0;
  for (const BoundaryFace& face : domain.openings) {
    (face.inflow_mps ? in_mps : out_mps) +=
        wind.u(face.inflow_mps ? 0 : domain.fluid.width(), face.cell.y);
  }
  EXPECT_NEAR(in_mps, 10.0, 1e-12);    // 10 faces at 1 m/s, summed
  EXPECT_NEAR(out_mps, in_mps, 1e-7);  // 1000 cells' tolerance
}

// Slow flow in a long channel: the discrete equations, upwind or not, are solved exactly by the
// parabola that vanishes on the solid cells' faces beside the channel. Start-up dies out as
// exp(-nu (pi / 0.8 m)^2 t), 1e-12 when averaging begins; the entrance within a channel's width.
TEST(WindTest, BecomesPoiseuilleFlowInAChannel) {
  constexpr int kRows = 7;
  constexpr double kInflow_mps = 0.1;
  WindOptions options;
  options.flow_s = 120.0;
  const MacField wind = SolveOrDie(Channel(40, kRows, kInflow_mps), options);
  for (const int x : {24, 28}) {
    for (int y = 1; y <= kRows; ++y) {
      const double parabola = y * (kRows + 1 - y) / 12.0;  // 12 is its mean over the 7 rows
      EXPECT_NEAR(wind.u(x, y), kInflow_mps * parabola, 1e-6) << x << ", " << y;
    }
  }
}

TEST(WindTest, IsSymmetricInASymmetricRoom) {
  const FlowDomain domain = SmallDomain();  // mirrors in y = 1.5 m
  const MacField wind = SolveOrDie(domain, ShortFlow());
  const int top = domain.fluid.height() - 1;
  for (int y = 0; y <= top; ++y) {
    for (int x = 0; x <= domain.fluid.width(); ++x) {
      // Rounding, amplified while the wake grows for 4 s at rates of a few per second.
      EXPECT_NEAR(wind.u(x, y), wind.u(x, top - y), 1e-6);
    }
  }
}

// What potential flow cannot do.
TEST(WindTest, TurnsBackInTheWakeOfABox) {
  Layout layout = SmallLayout();
  layout.boxes = {{{1.6, 0.8}, {1.8, 2.2}}};
  const MacField wind = SolveOrDie(Rasterize(layout)->flow, ShortFlow());
  double slowest_mps = 0.0;
  for (int x = 18; x < 26; ++x) slowest_mps = std::min(slowest_mps, wind.AtCenter({x, 14}).u_mps);
  EXPECT_LT(slowest_mps, -0.05);
}

TEST(WindTest, IsAtRestWithoutOpenings) {
  Layout layout = SmallLayout();
  layout.openings.clear();
  const MacField wind = SolveOrDie(Rasterize(layout)->flow, ShortFlow());
  EXPECT_EQ(wind.MaxMagnitudes().u_mps, 0.0);
  EXPECT_EQ(wind.MaxMagnitudes().v_mps, 0.0);
}

TEST(WindTest, IsTheSameEveryTime) {
  const MacField once = SolveOrDie(SmallDomain(), ShortFlow());
  MacField difference = SolveOrDie(SmallDomain(), ShortFlow());
  difference.AddScaled(once, -1.0);
  EXPECT_EQ(difference.MaxMagnitudes().u_mps, 0.0);
  EXPECT_EQ(difference.MaxMagnitudes().v_mps, 0.0);
}

TEST(WindTest, TellsHowFarItIs) {
  std::vector<double> told;
  ASSERT_TRUE(
      SolveWind(SmallDomain(), ShortFlow(), [&](double share) { told.push_back(share); }).ok());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1.0);
}

TEST(WindTest, RejectsOptionsOutOfRange) {
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    WindOptions options;
    options.viscosity_m2_per_s = bad;
    EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument);
    options = {};
    options.flow_s = bad;
    EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument);
    options = {};
    options.stability_share = bad;
    EXPECT_EQ(SolveWind(SmallDomain(), options).status().code(),
              absl::StatusCode::kInvalidArgument);
  }
}

}  // namespace
}  // namespace plumescout::lab
