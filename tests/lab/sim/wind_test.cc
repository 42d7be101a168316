// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/wind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/types/rng.h"
#include "lab/sim/layout_raster.h"
#include "tests/lab/sim/flow_domains.h"
#include "tests/lab/sim/small_layout.h"

namespace plumescout::lab {
namespace wind_test {

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

// The small room with some boxes, an opening more and a fan or two, all at random; may be invalid.
Layout RandomLayout(Rng& rng) {
  Layout layout = SmallLayout();
  layout.boxes.clear();
  for (int i = 0; i < 3; ++i) {
    const Point2 corner{rng.Uniform(0.2, 3.2), rng.Uniform(0.2, 2.2)};
    layout.boxes.push_back(
        {corner, {corner.x_m + rng.Uniform(0.2, 0.6), corner.y_m + rng.Uniform(0.2, 0.6)}});
  }
  const double from_m = rng.Uniform(0.3, 2.5);
  layout.openings.push_back({Side::kNorth, from_m, from_m + 0.5, std::nullopt});
  for (int i = 0; i < 2; ++i) {
    layout.fans.push_back({{rng.Uniform(0.5, 3.5), rng.Uniform(0.5, 2.5)},
                           rng.Uniform(-M_PI, M_PI),
                           rng.Uniform(0.2, 0.8),
                           rng.Uniform(0.5, 3.0)});
  }
  return layout;
}

// The arena of [XIT] section VII: closed, three fans. Their places are not printed.
Layout Arena() {
  Layout layout = SmallLayout();
  layout.size_x_m = 5.0;
  layout.size_y_m = 3.7;
  layout.boxes.clear();
  layout.openings.clear();
  layout.fans = {
      {{0.6, 1.0}, 0.0, 0.4, 2.0}, {{0.6, 2.7}, 0.0, 0.4, 2.0}, {{4.4, 2.0}, 2.5, 0.4, 1.0}};
  return layout;
}

TEST(WindTest, HasNoNetFlowIntoAnyFluidCell) {
  const FlowDomain domain = SmallDomain();
  const MacField wind = SolveOrDie(domain, ShortFlow());
  EXPECT_LT(WorstNetOutflow_mps(domain, wind), kSolverTolerance_mps);
  EXPECT_GT(wind.FastestCell_mps(), 0.5);
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

TEST(WindTest, ConservesAirInRandomLayoutsWithFansByBothModels) {
  Rng rng(5);
  int solved = 0;
  for (int i = 0; i < 60; ++i) {
    const auto raster = Rasterize(RandomLayout(rng));
    if (!raster.ok()) continue;
    for (const WindModel model : {WindModel::kNavierStokes, WindModel::kPotential}) {
      WindOptions options = ShortFlow();
      options.model = model;
      options.flow_s = 0.5;
      EXPECT_LT(WorstNetOutflow_mps(raster->flow, SolveOrDie(raster->flow, options)),
                kSolverTolerance_mps);
    }
    ++solved;
  }
  EXPECT_GE(solved, 5);
}

TEST(WindTest, ConservesAirInAClosedArenaWithThreeFans) {
  const FlowDomain domain = Rasterize(Arena())->flow;
  for (const WindModel model : {WindModel::kNavierStokes, WindModel::kPotential}) {
    WindOptions options = ShortFlow();
    options.model = model;
    const MacField wind = SolveOrDie(domain, options);
    EXPECT_LT(WorstNetOutflow_mps(domain, wind), kSolverTolerance_mps);
    EXPECT_NEAR(wind.u(6, 10), 2.0, 1e-12);  // on the first fan, all the time
  }
}

// A jet reaches across the room; potential flow returns around the fan.
TEST(WindTest, CarriesAFansJetOnlyWithNavierStokes) {
  Layout layout = Arena();
  layout.fans.resize(1);
  const FlowDomain domain = Rasterize(layout)->flow;
  WindOptions options;
  options.flow_s = 8.0;
  const Cell downwind = domain.fluid.geometry().CellAt({2.1, 1.0});  // 1.5 m off
  const double jet_mps = SolveOrDie(domain, options).AtCenter(downwind).u_mps;
  options.model = WindModel::kPotential;
  const double potential_mps = SolveOrDie(domain, options).AtCenter(downwind).u_mps;
  EXPECT_GT(jet_mps, 0.5);
  EXPECT_LT(potential_mps, 0.1);
}

// Slow flow in a long channel: the discrete equations are solved exactly by the parabola that is
// zero where the mean of a face's speed and its mirror image is, y (H - y) + h^2 / 4. Start-up dies
// out as exp(-nu (pi / 0.7 m)^2 t), 1e-15 when averaging begins; the entrance within a channel's
// width.
TEST(WindTest, BecomesPoiseuilleFlowInAChannel) {
  constexpr int kRows = 7;
  constexpr double kInflow_mps = 0.1;
  WindOptions options;
  options.flow_s = 120.0;
  const MacField wind = SolveOrDie(Channel(40, kRows, kInflow_mps), options);
  for (const int x : {24, 28}) {
    for (int y = 0; y < kRows; ++y) {
      const double at = y + 0.5;
      const double parabola = (at * (kRows - at) + 0.25) / 8.5;  // 8.5 is its mean over the rows
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

// What potential flow cannot do: its u has no extremes but at walls and openings.
TEST(WindTest, TurnsBackInTheWakeOfABoxOnlyWithNavierStokes) {
  Layout layout = SmallLayout();
  layout.boxes = {{{1.6, 0.8}, {1.8, 2.2}}};
  const FlowDomain domain = Rasterize(layout)->flow;
  const auto slowest_mps = [&](WindModel model) {
    WindOptions options = ShortFlow();
    options.model = model;
    const MacField wind = SolveOrDie(domain, options);
    double slowest = 1.0;
    for (int x = 18; x < 26; ++x) slowest = std::min(slowest, wind.AtCenter({x, 14}).u_mps);
    return slowest;
  };
  EXPECT_LT(slowest_mps(WindModel::kNavierStokes), -0.05);
  EXPECT_GT(slowest_mps(WindModel::kPotential), 0.0);
}

TEST(WindTest, RejectsAirThatHasNowhereToGo) {
  FlowDomain domain = SmallDomain();
  std::erase_if(domain.openings, [](const BoundaryFace& face) { return !face.inflow_mps; });
  EXPECT_EQ(SolveWind(domain, {}).status().code(), absl::StatusCode::kInvalidArgument);
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

}  // namespace wind_test
}  // namespace plumescout::lab
