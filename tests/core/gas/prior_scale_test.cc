// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/prior_scale.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/gas/gas_map.h"
#include "tests/core/gas/dense_field.h"
#include "tests/core/gas/field/field_case.h"

namespace plumescout {
namespace prior_scale_test {

using ::plumescout::testing::DenseField;
using ::plumescout::testing::DenseReading;

GasOptions Learning() {
  GasOptions gas;
  gas.precisions = GasPrecisions::kLearned;
  return gas;
}

Grid<CellState> Room(int side) {
  return Grid<CellState>(GridGeometry{0.0, 0.0, 0.1, side, side}, CellState::kFree);
}

// As precise as the mission's, so that they count as so many.
std::vector<DenseReading> Readings(const Grid<CellState>& states, int count, Rng& rng) {
  std::vector<DenseReading> readings;
  const double precision = GasOptions().observation_precision_per_ppm2;
  while (static_cast<int>(readings.size()) < count) {
    const Cell cell = states.geometry().CellAtIndex(rng.Below(states.size()));
    if (states[cell] != CellState::kFree) continue;
    readings.push_back({cell, precision, rng.Uniform(0.0, 30.0)});
  }
  return readings;
}

// The field of the readings from scratch, with the prior times theta.
PriorFit FitWith(double theta, const Grid<CellState>& states,
                 const std::vector<DenseReading>& readings) {
  const GasOptions gas;
  GasInputs inputs(gas, states.geometry().resolution_m);
  for (const DenseReading& r : readings) {
    inputs.Add(0, states.geometry().Center(r.cell), {r.concentration_ppm});
  }
  EXPECT_TRUE(inputs.Update(states, 0).ok());
  const GasLattice lattice = MakeLattice({}, inputs.rect(), 2);
  FieldOptions options;
  options.prior = PriorOf(gas, {.theta = theta});
  const FieldEngine field(static_cast<std::size_t>(lattice.width),
                          static_cast<std::size_t>(lattice.height), inputs.On(lattice), options);
  return PriorFitOf(field, lattice, inputs, gas);
}

// H without readings, and what each cell's readings weigh.
struct Dense {
  Dense(const Grid<CellState>& states, const std::vector<DenseReading>& readings)
      : prior(states, {}, GasOptions()),
        places(Eigen::MatrixXd::Zero(Size(readings), prior.hessian().rows())),
        z(Size(readings)) {
    for (std::size_t k = 0; k < readings.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const auto cell = std::find(prior.cells().begin(), prior.cells().end(), readings[k].cell);
      places(row, cell - prior.cells().begin()) = 1.0;
      z(row) = readings[k].concentration_ppm;
    }
    noise_ppm2 = 1.0 / readings.front().precision;
  }

  static Eigen::Index Size(const std::vector<DenseReading>& readings) {
    return static_cast<Eigen::Index>(readings.size());
  }

  // ln p(z | theta), up to what theta does not change: of the readings' own covariance.
  double LogLikelihood(double theta) const {
    Eigen::MatrixXd covariance = places * prior.hessian().inverse() * places.transpose() / theta;
    covariance.diagonal().array() += noise_ppm2;
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
    const double log_determinant =
        2.0 * factor.matrixL().toDenseMatrix().diagonal().array().log().sum();
    const double energy = z.dot(factor.solve(z));
    const double n = static_cast<double>(z.size());
    return -0.5 * log_determinant - (2.0 + 0.5 * n) * std::log(1.0 + 0.5 * energy);
  }

  // Lambda^1/2 H^-1 Lambda^1/2.
  Eigen::MatrixXd Shares(double theta) const {
    const Eigen::VectorXd precisions = places.colwise().sum().transpose() / noise_ppm2;
    const Eigen::MatrixXd hessian =
        theta * prior.hessian() + Eigen::MatrixXd(precisions.asDiagonal());
    const Eigen::VectorXd roots = precisions.cwiseSqrt();
    return roots.asDiagonal() * hessian.inverse() * roots.asDiagonal();
  }

  DenseField prior;
  Eigen::MatrixXd places;
  Eigen::VectorXd z;
  double noise_ppm2 = 0.0;
};

TEST(PriorScaleTest, SlopeAndCurvatureAreThoseOfTheMarginalLikelihood) {
  Rng rng(7);
  const Grid<CellState> states = testing::RandomStates(13, 11, 0.2, rng);
  const std::vector<DenseReading> readings = Readings(states, 50, rng);
  const Dense dense(states, readings);
  for (const double theta : {0.01, 0.2, 1.0, 8.0}) {
    SCOPED_TRACE(theta);
    constexpr double kStep = 1e-4;
    const double slope = (dense.LogLikelihood(theta * std::exp(kStep)) -
                          dense.LogLikelihood(theta * std::exp(-kStep))) /
                         (2.0 * kStep);
    const double of_prior = -std::log(theta) / (kPriorLogStddev * kPriorLogStddev);
    PriorFit fit = FitWith(theta, states, readings);
    EXPECT_NEAR(LogSlope(fit, theta), slope + of_prior, 1e-5);
    EXPECT_EQ(fit.readings, 50.0);
    EXPECT_EQ(fit.data, 50.0);
    const Eigen::MatrixXd shares = dense.Shares(theta);
    EXPECT_NEAR(fit.freedoms, shares.trace(), 1e-8);
    EXPECT_NEAR(fit.squared_freedoms, shares.diagonal().squaredNorm(), 1e-8);
    constexpr double kWideStep = 1e-2;
    const double observed =
        (2.0 * dense.LogLikelihood(theta) - dense.LogLikelihood(theta * std::exp(kWideStep)) -
         dense.LogLikelihood(theta * std::exp(-kWideStep))) /
        (kWideStep * kWideStep);
    EXPECT_LE(fit.squared_freedoms, shares.squaredNorm() + 1e-8);
    fit.squared_freedoms = shares.squaredNorm();  // tr(A^2)
    const double expected =
        0.5 * (fit.squared_freedoms - fit.freedoms * fit.freedoms / (4.0 + fit.data));
    EXPECT_NEAR(LogCurvature(fit),
                std::max(observed, expected) + 1.0 / (kPriorLogStddev * kPriorLogStddev), 1e-3);
  }
}

// A field drawn from the prior with theta and s, read at random.
std::vector<DenseReading> Drawn(const Grid<CellState>& states, int count, double theta,
                                double scale, Rng& rng) {
  const DenseField prior(states, {}, GasOptions());
  const Eigen::MatrixXd root = (prior.hessian() * (theta / scale)).llt().matrixU();
  Eigen::VectorXd white(root.rows());
  for (Eigen::Index i = 0; i < white.size(); ++i) white(i) = rng.Gaussian();
  const Eigen::VectorXd field = root.triangularView<Eigen::Upper>().solve(white);
  std::vector<DenseReading> readings = Readings(states, count, rng);
  for (DenseReading& reading : readings) {
    const auto cell = std::find(prior.cells().begin(), prior.cells().end(), reading.cell);
    reading.concentration_ppm =
        field(cell - prior.cells().begin()) + std::sqrt(scale / reading.precision) * rng.Gaussian();
  }
  return readings;
}

// As a mission does, refreshing after every few readings.
void Teach(const std::vector<DenseReading>& readings, const Grid<CellState>& states, GasMap& map) {
  for (std::size_t k = 0; k < readings.size(); ++k) {
    map.Add(0, states.geometry().Center(readings[k].cell), {readings[k].concentration_ppm});
    if (k % 10 != 9 && k + 1 != readings.size()) continue;
    ASSERT_TRUE(map.Refresh(states, 0).ok());
    if (!map.epoch_due(0)) continue;
    ASSERT_TRUE(map.BeginEpoch(0).ok());
    ASSERT_TRUE(map.Adopt().ok());
  }
}

TEST(PriorScaleTest, FindsThePrecisionsThatAFieldWasDrawnWith) {
  constexpr double kTheta = 0.1;
  constexpr double kScale = 400.0;
  Rng rng(11);
  const Grid<CellState> states = Room(20);
  const std::vector<DenseReading> readings = Drawn(states, 600, kTheta, kScale, rng);
  GasMap map(Learning());
  Teach(readings, states, map);
  const GasQuality quality = map.quality();
  ASSERT_GT(quality.prior_precision_log_stddev, 0.0);
  EXPECT_LT(quality.prior_precision_log_stddev, 0.5);
  // Three standard deviations, what the prior of mean 1 pulls, and steps that are not worth it.
  const double stddev = quality.prior_precision_log_stddev;
  EXPECT_NEAR(std::log(quality.prior_precision_scale), std::log(kTheta),
              3.1 * stddev - std::log(kTheta) * stddev * stddev);
  EXPECT_NEAR(std::log(quality.noise_scale), std::log(kScale), 4.0 * quality.noise_log_stddev);
  for (std::size_t i = 0; i < states.size(); ++i) {
    EXPECT_NEAR(map.error_variance_ppm2()[i],
                quality.noise_scale / quality.prior_precision_scale * map.variance_ppm2()[i],
                1e-5 * map.error_variance_ppm2()[i]);
  }
  EXPECT_TRUE(map.what_if() != nullptr);
  const Grid<float> beside = map.what_if()->variance_ppm2();
  for (std::size_t i = 0; i < states.size(); ++i) {
    EXPECT_FLOAT_EQ(beside[i], map.variance_ppm2()[i]);
  }
}

TEST(PriorScaleTest, WhereItBeginsIsForgotten) {
  Rng rng(13);
  const Grid<CellState> states = Room(20);
  const std::vector<DenseReading> readings = Drawn(states, 600, 0.1, 400.0, rng);
  const auto learned = [&](double begin) {
    const GasOptions gas = WithPriorScale(Learning(), {.theta = begin});
    GasMap map(gas);
    Teach(readings, states, map);
    return map.mean_ppm();
  };
  const Grid<float> one = learned(1.0);
  const Grid<float> other = learned(0.01);
  double square = 0.0;
  double difference = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    square += one[i] * one[i];
    difference += (one[i] - other[i]) * (one[i] - other[i]);
  }
  EXPECT_LT(difference, 0.05 * 0.05 * square);
}

// Readings along the way are told in parts, each of which is a datum, and less precise.
TEST(PriorScaleTest, WhereItBeginsIsForgottenAlongTheWay) {
  constexpr double kTheta = 0.1;
  constexpr int kParts = 5;
  Rng rng(29);
  const Grid<CellState> states = Room(20);
  const std::vector<DenseReading> parts = Drawn(states, 400, kTheta, 400.0, rng);
  const double part_variance_ppm2 = kParts / parts.front().precision;
  for (const double begin : {0.01, 1.0, 5.0}) {
    SCOPED_TRACE(begin);
    GasMap map(WithPriorScale(Learning(), {.theta = begin}));
    int k = 0;
    for (const DenseReading& part : parts) {
      map.Add(0, states.geometry().Center(part.cell), {part.concentration_ppm, part_variance_ppm2},
              k++ % kParts != 0);
    }
    ASSERT_TRUE(map.Refresh(states, 0).ok());
    for (int lesson = 0; lesson < 12; ++lesson) {
      ASSERT_TRUE(map.BeginEpoch(0).ok());
      ASSERT_TRUE(map.Adopt().ok());
    }
    const GasQuality quality = map.quality();
    EXPECT_EQ(map.counters().in_posterior, 80);
    // What makes data less precise makes the prior weaker and the noise less.
    const double truth = std::log(kTheta / kParts / begin);
    const double stddev = quality.prior_precision_log_stddev;
    EXPECT_NEAR(std::log(quality.prior_precision_scale), truth,
                3.1 * stddev + std::abs(truth) * stddev * stddev);
    EXPECT_LT(stddev, 0.5);
  }
}

// A step that was cut short is followed by the next before there are half as many readings again.
TEST(PriorScaleTest, FarFromTheBestTheNextLessonComesSoon) {
  PriorFit fit;
  fit.readings = fit.data = 200.0;
  fit.energy = fit.prior_energy = 20'000.0;
  fit.freedoms = fit.squared_freedoms = 120.0;
  const PriorScale far = Improved({}, fit, 200);
  EXPECT_NEAR(far.theta, std::exp(-kMostLogStep), 1e-12) << LogSlope(fit, 1.0);
  EXPECT_FALSE(IsLessonDue(far, 218));
  EXPECT_TRUE(IsLessonDue(far, 220));
  fit.prior_energy = fit.freedoms / (4.0 + fit.data) * (2.0 + fit.energy);
  const PriorScale there = Improved({}, fit, 200);
  EXPECT_EQ(there.theta, 1.0);
  EXPECT_FALSE(IsLessonDue(there, 299));
  EXPECT_TRUE(IsLessonDue(there, 300));
  // Where a bound holds it back more readings do not help.
  fit.energy = 100.0;
  fit.prior_energy = 0.0;
  const PriorScale held = Improved({}, fit, 200);
  EXPECT_EQ(held.theta, 1.0);
  EXPECT_FALSE(IsLessonDue(held, 299));
}

// Readings far from anything that the model draws: no precision leaves its bounds, and nothing is
// surer than the model with the precisions of the options.
TEST(PriorScaleTest, OddReadingsMakeNoFieldSurerThanItsOptions) {
  struct Odd {
    std::string name;
    int count = 0;
    std::function<double(int)> ppm;
    int side = 12;  // of the part of the room that is read
  };
  const std::vector<Odd> cases = {
      {"none", 0, [](int) { return 0.0; }},
      {"one", 1, [](int) { return 50.0; }},
      {"all zero", 200, [](int) { return 0.0; }},
      {"all equal", 200, [](int) { return 50.0; }},
      {"a million beside zeros", 40, [](int k) { return k == 7 ? 1e6 : 0.0; }},
      {"one corner", 200, [](int k) { return 20.0 + 5.0 * (k % 3); }, 3},
      {"stuck after a while", 200, [](int k) { return k < 30 ? k * 1.0 : 9999.0; }},
      {"least", 200, [](int k) { return k % 2 == 0 ? 1e-12 : 0.0; }},
  };
  const Grid<CellState> states = Room(12);
  for (const Odd& odd : cases) {
    SCOPED_TRACE(odd.name);
    Rng rng(17);
    GasMap map(Learning());
    GasMap plain{GasOptions()};
    for (int k = 0; k < odd.count; ++k) {
      const auto draw = [&] {
        return 0.05 + 0.1 * static_cast<double>(rng.Below(static_cast<std::uint64_t>(odd.side)));
      };
      const double x_m = draw();
      const Point2 place{x_m, draw()};
      map.Add(0, place, {odd.ppm(k)});
      plain.Add(0, place, {odd.ppm(k)});
    }
    ASSERT_TRUE(map.Refresh(states, 0).ok());
    ASSERT_TRUE(plain.Refresh(states, 0).ok());
    for (int lesson = 0; lesson < 12; ++lesson) {
      ASSERT_TRUE(map.BeginEpoch(0).ok());
      ASSERT_TRUE(map.Adopt().ok());
      const GasQuality quality = map.quality();
      ASSERT_GE(quality.prior_precision_scale, kLeastPriorScale);
      ASSERT_LE(quality.prior_precision_scale, std::min(kMostPriorScale, quality.noise_scale));
      ASSERT_LE(quality.prior_precision_log_stddev, kPriorLogStddev);
      for (std::size_t i = 0; i < states.size(); ++i) {
        ASSERT_TRUE(std::isfinite(map.mean_ppm()[i]));
        ASSERT_TRUE(std::isfinite(map.error_variance_ppm2()[i]));
        ASSERT_GE(map.error_variance_ppm2()[i], 0.999F * plain.variance_ppm2()[i]);
      }
    }
  }
}

TEST(PriorScaleTest, IsFixedUnlessItIsLearned) {
  Rng rng(19);
  const Grid<CellState> states = Room(12);
  const std::vector<DenseReading> readings = Drawn(states, 100, 0.1, 400.0, rng);
  GasMap map{GasOptions()};
  Teach(readings, states, map);
  EXPECT_EQ(map.quality().epochs, 0);
  ASSERT_TRUE(map.BeginEpoch(0).ok());
  ASSERT_TRUE(map.Adopt().ok());
  EXPECT_EQ(map.quality().prior_precision_scale, 1.0);
  EXPECT_EQ(map.quality().prior_precision_log_stddev, 0.0);
}

TEST(PriorScaleTest, LearnedPrecisionsNeedTheirNoise) {
  GasOptions gas = Learning();
  EXPECT_TRUE(Validate(gas).ok());
  gas.estimate_noise = false;
  EXPECT_EQ(Validate(gas).message(),
            "gas.estimate_noise = 0 must be true where gas.precisions are learned");
}

// What changes with the precisions is no drift, and the audit knows them.
TEST(PriorScaleTest, AuditsKnowWhatWasLearned) {
  Rng rng(23);
  const Grid<CellState> states = Room(12);
  GasMap map(Learning());
  Teach(Drawn(states, 200, 0.1, 400.0, rng), states, map);
  EXPECT_LT(map.quality().prior_precision_scale, 0.5);
  EXPECT_LE(map.quality().drift_variance_ratio, 1e-5);
  const auto audit = map.MakeAudit();
  ASSERT_NE(audit, nullptr);
  const auto finding = RunAudit(*audit);
  ASSERT_TRUE(finding.ok()) << finding.status();
  EXPECT_TRUE(finding->certified);
}

}  // namespace prior_scale_test
}  // namespace plumescout
