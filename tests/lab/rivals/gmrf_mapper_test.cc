// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/gmrf_mapper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/core/gas/dense_field.h"
#include "tests/support/grid_art.h"

namespace plumescout::lab {
namespace gmrf_mapper_test {

using ::plumescout::testing::DenseField;
using ::plumescout::testing::DenseReading;
using ::plumescout::testing::GridFromArt;

// The posterior itself is good to 1e-9 (see posterior_test); the map is in floats.
constexpr double kRelative = 1e-6;

TEST(GmrfMapperTest, EqualsTheDenseInverse) {
  Rng rng(11);
  GasOptions options;
  options.prior_precision_per_ppm2 = 0.5;
  options.background_mean_ppm = 4.0;
  const Grid<CellState> states = testing::RandomStates(12, 9, 0.25, rng);
  const std::vector<DenseReading> readings = testing::RandomReadings(states, 14, rng);
  GmrfMapper mapper(options);
  for (const DenseReading& r : readings) {
    const Point2 at = states.geometry().Center(r.cell);
    ASSERT_TRUE(mapper.Add(at, {r.concentration_ppm, 1.0 / r.precision}).ok());
  }
  const MappedGas gas = mapper.MapOver(states).value();
  const DenseField oracle(states, readings, options);
  for (std::size_t i = 0; i < oracle.cells().size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(gas.mean_ppm[oracle.cells()[i]], oracle.mean_ppm()(k), kRelative * 50.0);
    EXPECT_NEAR(gas.variance_ppm2[oracle.cells()[i]] / oracle.variance_ppm2()(k), 1.0, kRelative);
  }
}

TEST(GmrfMapperTest, SaysNothingOfCellsThatAreNotFree) {
  GmrfMapper mapper(GasOptions{});
  const MappedGas gas = mapper.MapOver(GridFromArt({".#?"})).value();
  EXPECT_EQ(gas.mean_ppm[(Cell{0, 0})], 0.0F);
  EXPECT_TRUE(std::isnan(gas.mean_ppm[(Cell{1, 0})]) &&
              std::isnan(gas.variance_ppm2[(Cell{2, 0})]));
}

TEST(GmrfMapperTest, AReadingInAWallWaitsForAMapInWhichItIsFree) {
  GmrfMapper mapper(GasOptions{});
  ASSERT_TRUE(mapper.Add({0.15, 0.05}, {20.0, 0.0}).ok());
  EXPECT_EQ(mapper.MapOver(GridFromArt({".#."})).value().mean_ppm[(Cell{0, 0})], 0.0F);
  EXPECT_GT(mapper.MapOver(GridFromArt({"..."})).value().mean_ppm[(Cell{0, 0})], 1.0F);
}

TEST(GmrfMapperTest, RefusesReadingsThatAreNotFinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  GmrfMapper mapper(GasOptions{});
  EXPECT_TRUE(absl::IsInvalidArgument(mapper.Add({0.05, 0.05}, {kInfinity, 0.0})));
  EXPECT_TRUE(absl::IsInvalidArgument(mapper.Add({0.05, kInfinity}, {1.0, 0.0})));
  EXPECT_EQ(mapper.MapOver(GridFromArt({"."})).value().mean_ppm[0], 0.0F);
}

TEST(GmrfMapperTest, AMapWithoutFreeCellsIsEmptyOfGas) {
  GmrfMapper mapper(GasOptions{});
  EXPECT_TRUE(std::isnan(mapper.MapOver(GridFromArt({"##"})).value().mean_ppm[0]));
}

}  // namespace gmrf_mapper_test
}  // namespace plumescout::lab
