// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/noise_scale.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/gas/gas_map.h"
#include "tests/core/gas/dense_field.h"
#include "tests/core/gas/field/field_case.h"

namespace plumescout {
namespace noise_scale_test {

using ::plumescout::testing::DenseField;
using ::plumescout::testing::DenseReading;

GasOptions Estimated(double background_ppm = 0.0) {
  GasOptions gas = PublishedGasOptions();
  gas.background_mean_ppm = background_ppm;
  return gas;
}

Grid<CellState> Room(int side) {
  return Grid<CellState>(GridGeometry{0.0, 0.0, 0.1, side, side}, CellState::kFree);
}

void Add(const std::vector<DenseReading>& readings, const Grid<CellState>& states, GasMap& map) {
  for (const DenseReading& r : readings) {
    map.Add(0, states.geometry().Center(r.cell), {r.concentration_ppm, 1.0 / r.precision});
  }
}

// z^T C^-1 z with the covariance of readings that the model says they have.
double DenseEnergy(const Grid<CellState>& states, const std::vector<DenseReading>& readings,
                   const GasOptions& gas) {
  const DenseField prior(states, {}, gas);
  const auto n = static_cast<Eigen::Index>(readings.size());
  Eigen::MatrixXd places = Eigen::MatrixXd::Zero(n, prior.hessian().rows());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd z(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const DenseReading& reading = readings[static_cast<std::size_t>(k)];
    const auto cell = std::find(prior.cells().begin(), prior.cells().end(), reading.cell);
    places(k, cell - prior.cells().begin()) = 1.0;
    covariance(k, k) = 1.0 / reading.precision;
    z(k) = reading.concentration_ppm - gas.background_mean_ppm;
  }
  covariance += places * prior.hessian().inverse() * places.transpose();
  return z.dot(covariance.ldlt().solve(z));
}

TEST(NoiseScaleTest, IsTheMeanOfWhatTheFitSays) {
  EXPECT_DOUBLE_EQ(NoiseScale({.energy = 98.0, .readings = 8.0}), 10.0);
  EXPECT_EQ(NoiseScale({}), 1.0);
  EXPECT_EQ(NoiseScale({.energy = 3.0, .readings = 100.0}), 1.0);
  EXPECT_EQ(NoiseScale({.energy = -1e-9, .readings = 100.0}), 1.0);
}

TEST(NoiseScaleTest, AFieldKnowsTheEnergyOfItsReadings) {
  Rng rng(3);
  const Grid<CellState> states = testing::RandomStates(14, 12, 0.2, rng);
  const std::vector<DenseReading> readings = testing::RandomReadings(states, 40, rng);
  const GasOptions gas = Estimated(3.0);
  GasMap map(gas);
  const std::vector<DenseReading> first(readings.begin(), readings.begin() + 20);
  Add(first, states, map);
  ASSERT_TRUE(map.Refresh(states, 0).ok());
  Add({readings.begin() + 20, readings.end()}, states, map);
  ASSERT_TRUE(map.Refresh(states, 0).ok());
  const double expected =
      NoiseScale({.energy = DenseEnergy(states, readings, gas), .readings = 40.0});
  ASSERT_GT(expected, 1.0);
  EXPECT_NEAR(map.noise_scale(), expected, 1e-3 * expected);
  EXPECT_EQ(map.quality().noise_scale, map.noise_scale());
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] != CellState::kFree) continue;
    const double variance_ppm2 = map.variance_ppm2()[i];
    EXPECT_NEAR(map.error_variance_ppm2()[i], map.noise_scale() * variance_ppm2,
                1e-6 * map.noise_scale() * variance_ppm2);
  }
}

TEST(NoiseScaleTest, LevelsHaveTheUnitOfTheField) {
  GasOptions gas;
  EXPECT_EQ(LevelScale(gas, 0.0), 5.0);
  EXPECT_NEAR(LevelScale(gas, 10.0), 10.0 * (0.5 + 10.0 * std::sqrt(3.0)), 1e-12);
  EXPECT_EQ(LevelScale(gas, -10.0), LevelScale(gas, 10.0));
  const double in_ppm = LevelScale(gas, 10.0);
  gas.prior_precision_per_ppm2 *= 1e-6;  // the same gas in ppb
  EXPECT_NEAR(LevelScale(gas, 10.0e3), in_ppm, 1e-9);
}

TEST(NoiseScaleTest, IsByLevelWhereFieldsAreLinearAndPrecisionsGiven) {
  EXPECT_TRUE(HasNoiseByLevel(GasOptions{}));
  EXPECT_FALSE(HasNoiseByLevel(PublishedGasOptions()));
  GasOptions gas;
  gas.estimate_noise = false;
  EXPECT_FALSE(HasNoiseByLevel(gas));
  gas = {};
  gas.scale = GasScale::kSquareRoot;
  EXPECT_FALSE(HasNoiseByLevel(gas));
  gas = {};
  gas.precisions = GasPrecisions::kLearned;
  EXPECT_FALSE(HasNoiseByLevel(gas));
  const NoiseEstimate noise{.scale = 3.0, .level_scale = 2.0};
  EXPECT_EQ(noise.VarianceOf_ppm2(gas, 0.5, 5.0, 6.0), 1.5);
  EXPECT_EQ(noise.VarianceOf_ppm2({}, 1.0, 0.0, 0.0), 10.0);
  gas = {};
  gas.unread_discount_ratio = 0.0;
  EXPECT_EQ(LevelScale(gas, 0.0), 6.5);
}

TEST(NoiseScaleTest, GustsAddAShareOfWhatThereIsAndDiscountsWhatTheyTake) {
  const NoiseEstimate noise{.level_scale = 2.0};
  GasOptions gas;
  gas.gust_ratio = 0.5;
  // 2 (5 * 0.1 + (0.5 * 4)^2) and twice the 3 ppm that were discounted.
  EXPECT_NEAR(noise.VarianceOf_ppm2(gas, 0.1, 4.0, 7.0), 9.0 + 36.0, 1e-12);
  EXPECT_NEAR(noise.VarianceOf_ppm2(gas, 0.1, -4.0, -7.0), 9.0 + 36.0, 1e-12);
  gas.gust_ratio = 0.0;
  EXPECT_NEAR(noise.VarianceOf_ppm2(gas, 0.1, 4.0, 7.0), 0.2 * LevelScale(gas, 4.0), 1e-12);
}

// By the means of a dense solution: each reading's part of the energy is lambda z (z - m).
TEST(NoiseScaleTest, VariancesGrowWithTheLevelAndWithWhatReadingsSayBeside) {
  Rng rng(3);
  const Grid<CellState> states = testing::RandomStates(14, 12, 0.2, rng);
  std::vector<DenseReading> readings = testing::RandomReadings(states, 40, rng);
  for (const auto& [times, gusts] : {std::pair(1.0, 0.14), {20.0, 0.14}, {1.0, 0.0}}) {
    for (DenseReading& reading : readings) reading.concentration_ppm *= times;
    GasOptions gas;
    gas.background_mean_ppm = 3.0;
    gas.gust_ratio = gusts;
    GasMap map(gas);
    Add(readings, states, map);
    ASSERT_TRUE(map.Refresh(states, 0).ok());
    const DenseField dense(states, readings, gas);
    double energy = 0.0;
    for (const DenseReading& r : readings) {
      const auto cell = std::find(dense.cells().begin(), dense.cells().end(), r.cell);
      const double mean = dense.mean_ppm()(cell - dense.cells().begin());
      const double z = r.concentration_ppm - 3.0;
      energy += r.precision * z * (r.concentration_ppm - mean) / LevelScale(gas, mean - 3.0);
    }
    const double beside = NoiseScale({.energy = energy, .readings = 40.0});
    EXPECT_NEAR(map.quality().clean_air_scale, 5.0 * beside, 1e-3 * beside);
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states[i] != CellState::kFree) continue;
      const double variance = map.variance_ppm2()[i];
      const double told = map.mean_ppm()[i] - 3.0;
      const double share = gas.unread_discount_ratio * variance / OpenLatticeVariance_ppm2(gas);
      const double discount = told * share * share;  // of told (1 + share^2)
      const double gust = gas.gust_ratio * told;
      const double expected = gas.gust_ratio == 0.0 ? beside * LevelScale(gas, told) * variance
                                                    : beside * (5.0 * variance + gust * gust) +
                                                          4.0 * discount * discount;
      EXPECT_NEAR(map.error_variance_ppm2()[i], expected, 1e-3 * expected);
    }
  }
}

TEST(NoiseScaleTest, IsOneOfSensorsThatAreAsNoisyAsTheySay) {
  Rng rng(7);
  const Grid<CellState> states = Room(20);
  for (const double stddev_ppm : {0.3, 1.0, 10.0}) {
    GasMap map{GasOptions()};
    for (int k = 0; k < 600; ++k) {
      const Point2 place{rng.Uniform(0.0, 2.0), rng.Uniform(0.0, 2.0)};
      map.Add(0, place, {stddev_ppm * rng.Gaussian(), stddev_ppm * stddev_ppm});
    }
    ASSERT_TRUE(map.Refresh(states, 0).ok());
    EXPECT_LT(map.noise_scale(), 1.2) << stddev_ppm;
    EXPECT_LT(map.quality().clean_air_scale, 6.0) << stddev_ppm;
  }
}

// What was read long ago deviates by less than its variance has grown to: it counts for less, too.
TEST(NoiseScaleTest, ReadingsThatAgedMakeAFieldNoSurer) {
  GasOptions gas = Estimated();
  gas.ageing_half_life_s = 1.0;
  std::vector<double> scale;  // without old ones, and with
  for (const bool old_ones : {false, true}) {
    Rng rng(5);
    GasMap map(gas);
    constexpr std::int64_t kNow_ns = 1'000'000'000'000;
    for (int k = 0; k < 400; ++k) {
      const Point2 place{rng.Uniform(0.0, 2.0), rng.Uniform(0.0, 2.0)};
      const double ppm = 20.0 * rng.Gaussian();
      if (k >= 200) {
        map.Add(kNow_ns, place, {ppm});
      } else if (old_ones) {
        map.Add(0, place, {0.0});
      }
    }
    ASSERT_TRUE(map.Refresh(Room(20), kNow_ns).ok());
    scale.push_back(map.noise_scale());
  }
  EXPECT_GT(scale[0], 10.0);
  EXPECT_NEAR(scale[1], scale[0], 0.05 * scale[0]);
}

TEST(NoiseScaleTest, IsNotEstimatedUnlessAskedFor) {
  GasOptions fixed = PublishedGasOptions();
  fixed.estimate_noise = false;
  GasMap map(fixed);
  map.Add(0, {0.35, 0.35}, {50.0});
  ASSERT_TRUE(map.Refresh(Room(8), 0).ok());
  EXPECT_EQ(map.noise_scale(), 1.0);
  EXPECT_EQ(&map.error_variance_ppm2(), &map.variance_ppm2());
}

TEST(NoiseScaleTest, OddReadingsNeverMakeAFieldSurer) {
  for (const double ppm : {0.0, 50.0}) {
    GasOptions options = Estimated();
    options.noise_by_level = ppm > 0.0;
    GasMap map(options);
    GasMap plain{PublishedGasOptions()};
    for (int k = 0; k < 200; ++k) {
      const Point2 place{0.05 + 0.1 * (k % 8), 0.05 + 0.1 * (k / 8 % 8)};
      map.Add(0, place, {ppm});
      plain.Add(0, place, {ppm});
    }
    ASSERT_TRUE(map.Refresh(Room(8), 0).ok());
    ASSERT_TRUE(plain.Refresh(Room(8), 0).ok());
    for (std::size_t i = 0; i < map.mean_ppm().size(); ++i) {
      EXPECT_GE(map.error_variance_ppm2()[i], plain.variance_ppm2()[i]);
      EXPECT_TRUE(std::isfinite(map.error_variance_ppm2()[i]));
    }
  }
}

TEST(NoiseScaleTest, OneReadingBeyondAllOthersMakesItUnsure) {
  for (const bool alone : {true, false}) {
    GasMap map(Estimated());
    map.Add(0, {0.35, 0.35}, {1e6});
    if (!alone) map.Add(0, {0.45, 0.35}, {0.0});
    ASSERT_TRUE(map.Refresh(Room(8), 0).ok());
    for (const float variance_ppm2 : map.error_variance_ppm2().values()) {
      EXPECT_TRUE(std::isfinite(variance_ppm2));
      // The prior has 17 ppm^2 at most: with three in the denominator a factor of 1e10 and more,
      // and cells that nobody read have 0.05 ppm^2 and more left.
      if (alone) {
        EXPECT_GT(variance_ppm2, 1e8F);
      }
    }
    EXPECT_GT(map.noise_scale(), 1e9);
  }
}

// Of missions by default: errors are finite, wider than the model's and than gusts of what is told.
TEST(NoiseScaleTest, DefaultErrorsOfOddReadingsAreFiniteAndWide) {
  const auto everywhere = [](double ppm) { return [ppm](int) { return ppm; }; };
  const std::vector<std::function<double(int)>> odd = {
      everywhere(0.0), everywhere(50.0), everywhere(1e6), [](int k) { return k == 0 ? 1e6 : 0.0; }};
  for (std::size_t i = 0; i < odd.size(); ++i) {
    for (const int count : {1, 200}) {
      const GasOptions gas;
      GasMap map(gas);
      for (int k = 0; k < count; ++k) {
        const Point2 place{0.05 + 0.1 * (k % 8), 0.05 + 0.1 * (k / 8 % 4)};  // in one half
        map.Add(0, place, {odd[i](k)});
      }
      ASSERT_TRUE(map.Refresh(Room(8), 0).ok());
      for (std::size_t cell = 0; cell < map.mean_ppm().size(); ++cell) {
        const double error_ppm2 = map.error_variance_ppm2()[cell];
        const double gust_ppm = gas.gust_ratio * map.mean_ppm()[cell];
        EXPECT_TRUE(std::isfinite(error_ppm2)) << i << ' ' << count;
        EXPECT_GE(error_ppm2, 4.99 * map.variance_ppm2()[cell]) << i << ' ' << count;
        EXPECT_GE(error_ppm2, 0.999 * gust_ppm * gust_ppm) << i << ' ' << count;
      }
    }
  }
}

TEST(NoiseScaleTest, AFieldOfRootsIsALinearOneOfTheRoots) {
  Rng rng(5);
  const Grid<CellState> states = Room(10);
  GasOptions options = PublishedGasOptions();
  options.estimate_noise = false;
  GasMap linear(options);
  options.scale = GasScale::kSquareRoot;
  GasMap roots(options);
  for (int k = 0; k < 30; ++k) {
    const Point2 place{rng.Uniform(0.0, 1.0), rng.Uniform(0.0, 1.0)};
    const double root = rng.Uniform(0.0, 6.0);
    linear.Add(0, place, {root});
    roots.Add(0, place, {root * root});
  }
  ASSERT_TRUE(linear.Refresh(states, 0).ok());
  ASSERT_TRUE(roots.Refresh(states, 0).ok());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double mean = linear.mean_ppm()[i];
    const double variance = linear.variance_ppm2()[i];
    EXPECT_NEAR(roots.mean_ppm()[i], mean * mean, 1e-4);
    EXPECT_NEAR(roots.variance_ppm2()[i], variance, 1e-6);
    const double expected_ppm2 = (4.0 * mean * mean + 2.0 * variance) * variance;
    EXPECT_NEAR(roots.error_variance_ppm2()[i], expected_ppm2, 1e-4 * (1.0 + expected_ppm2));
  }
}

}  // namespace noise_scale_test
}  // namespace plumescout
