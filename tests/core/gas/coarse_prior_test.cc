// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/coarse_prior.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/gas/gas_map.h"

namespace plumescout {
namespace coarse_prior_test {

constexpr int kSide = 161;
constexpr Cell kMiddle{kSide / 2, kSide / 2};

GasOptions Coarse(int factor, bool by_area = true) {
  GasOptions options;
  options.lattice_factor = factor;
  options.background_by_area = by_area;
  options.unread_discount_ratio = 0.0;
  return options;
}

// Open ground with a few readings around the middle, three cells apart.
std::unique_ptr<GasMap> MapOf(const GasOptions& options) {
  const Grid<CellState> states(GridGeometry{0.0, 0.0, 0.1, kSide, kSide}, CellState::kFree);
  auto map = std::make_unique<GasMap>(options);
  for (int y = -2; y <= 2; ++y) {
    for (int x = -2; x <= 2; ++x) {
      map->Add(0, states.geometry().Center({kMiddle.x + 3 * x, kMiddle.y + 3 * y}), {10.0});
    }
  }
  EXPECT_TRUE(map->Refresh(states, 0).ok());
  return map;
}

TEST(CoarsePriorTest, LambdaDIsOfTheAreaAndWhatIsWithinACellIsMissing) {
  const GasOptions gas = Coarse(4);
  EXPECT_EQ(BackgroundPrecision_per_ppm2(gas), 16.0 * gas.background_precision_per_ppm2);
  GasOptions on_lattice = gas;
  on_lattice.background_precision_per_ppm2 = BackgroundPrecision_per_ppm2(gas);
  EXPECT_NEAR(OpenLatticeVariance_ppm2(on_lattice) + VarianceWithinCell_ppm2(gas),
              OpenLatticeVariance_ppm2(gas), 1e-12);
}

TEST(CoarsePriorTest, NothingChangesOnTheFullLatticeAndWhereItIsOff) {
  for (const GasOptions& gas : {Coarse(1), Coarse(1, false), Coarse(8, false)}) {
    EXPECT_EQ(BackgroundPrecision_per_ppm2(gas), gas.background_precision_per_ppm2);
    EXPECT_EQ(VarianceWithinCell_ppm2(gas), 0.0);
  }
}

TEST(CoarsePriorTest, CoarserLatticesHaveNearlyTheFieldOfTheFullOne) {
  const auto full = MapOf(Coarse(1));
  for (const int factor : {2, 4}) {
    const auto coarse = MapOf(Coarse(factor));
    const auto by_cell = MapOf(Coarse(factor, false));
    for (const int away : {20, 30, 40}) {
      const Cell cell{kMiddle.x + away, kMiddle.y};
      const double mean_ppm = full->mean_ppm()[cell];
      EXPECT_NEAR(coarse->mean_ppm()[cell] / mean_ppm, 1.0, 0.15) << factor << ", " << away;
      EXPECT_GT(by_cell->mean_ppm()[cell] / mean_ppm, 1.4) << factor << ", " << away;
      EXPECT_NEAR(coarse->variance_ppm2()[cell] / full->variance_ppm2()[cell], 1.0, 0.03);
    }
  }
}

// As plans take it that see a coarse field beside what is priced in it.
TEST(CoarsePriorTest, WhatIfSeesTheVariancesOfTheMap) {
  for (const auto precisions : {GasPrecisions::kFixed, GasPrecisions::kLearned}) {
    GasOptions options = Coarse(4);
    options.precisions = precisions;
    const auto map = MapOf(options);
    ASSERT_TRUE(map->BeginEpoch(0).ok());
    ASSERT_TRUE(map->Adopt().ok());
    const Grid<float> seen_ppm2 = map->what_if()->variance_ppm2();
    for (std::size_t i = 0; i < seen_ppm2.size(); ++i) {
      EXPECT_FLOAT_EQ(seen_ppm2[i], map->variance_ppm2()[i]);
    }
  }
}

}  // namespace coarse_prior_test
}  // namespace plumescout
