// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/oracle.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/types/rng.h"

namespace plumescout::lab {
namespace oracle_test {

// Six by five cells with a wall; some of them critical.
Scene TinyScene() {
  Scene scene;
  scene.name = "tiny";
  const GridGeometry geometry{0.0, 0.0, 0.1, 6, 5};
  scene.occupancy = Grid<CellState>(geometry, CellState::kFree);
  for (int y = 0; y < 4; ++y) scene.occupancy[Cell{3, y}] = CellState::kOccupied;
  scene.conc_mean_ppm = Grid<float>(geometry, 0.0F);
  Rng rng(7);
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    if (scene.occupancy[i] == CellState::kFree) {
      scene.conc_mean_ppm[i] = static_cast<float>(rng.Uniform(0.0, 12.0));
    }
  }
  scene.critical_threshold_ppm = 4.0;
  return scene;
}

// The same by dense algebra: every set of two readings, one after the other.
class DenseOracle {
 public:
  DenseOracle(const Scene& scene, const GasOptions& gas)
      : noise_(1.0 / gas.observation_precision_per_ppm2) {
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < scene.occupancy.size(); ++i) {
      if (scene.occupancy[i] == CellState::kFree) {
        cells.push_back(scene.occupancy.geometry().CellAtIndex(i));
      }
    }
    const auto n = static_cast<Eigen::Index>(cells.size());
    Eigen::MatrixXd precision = Eigen::MatrixXd::Identity(n, n) * gas.background_precision_per_ppm2;
    truth_ = Eigen::VectorXd(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Cell a = cells[static_cast<std::size_t>(i)];
      truth_(i) = scene.conc_mean_ppm[a];
      if (truth_(i) > scene.critical_threshold_ppm) critical_.push_back(i);
      for (Eigen::Index j = 0; j < n; ++j) {
        const Cell b = cells[static_cast<std::size_t>(j)];
        if (std::abs(a.x - b.x) + std::abs(a.y - b.y) != 1) continue;
        precision(i, i) += gas.prior_precision_per_ppm2;
        precision(i, j) -= gas.prior_precision_per_ppm2;
      }
    }
    covariance_ = precision.inverse();
    mean_ = Eigen::VectorXd::Zero(n);
  }

  void Read(Eigen::Index c) {
    const Eigen::VectorXd gain = covariance_.col(c) / (covariance_(c, c) + noise_);
    mean_ += gain * (truth_(c) - mean_(c));
    covariance_ -= gain * covariance_.row(c).eval();
  }

  const std::vector<Eigen::Index>& critical() const { return critical_; }

  double Rmse() const {
    double sum = 0.0;
    for (const Eigen::Index c : critical_) sum += std::pow(mean_(c) - truth_(c), 2);
    return std::sqrt(sum / static_cast<double>(critical_.size()));
  }
  double Entropy() const {
    double sum = 0.0;
    for (const Eigen::Index c : critical_) {
      sum += 0.5 * std::log(2.0 * M_PI * M_E * covariance_(c, c));
    }
    return sum;
  }

 private:
  double noise_;
  Eigen::MatrixXd covariance_;
  Eigen::VectorXd mean_;
  Eigen::VectorXd truth_;
  std::vector<Eigen::Index> critical_;
};

// The greedy choice by trying every critical cell.
template <typename Figure>
DenseOracle PlaceByTrying(DenseOracle oracle, int readings, const Figure& figure) {
  for (int k = 0; k < readings; ++k) {
    DenseOracle best = oracle;
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::Index c : oracle.critical()) {
      DenseOracle tried = oracle;
      tried.Read(c);
      if (figure(tried) < least) {
        least = figure(tried);
        best = tried;
      }
    }
    oracle = std::move(best);
  }
  return oracle;
}

constexpr double kSinglePrecision = 2e-5;  // relative, of a few products of floats

TEST(Oracle, WithoutReadingsIsThePrior) {
  const Scene scene = TinyScene();
  const auto metrics = PlaceReadings(scene, GasOptions{}, 0, OracleAim::kEntropy);
  ASSERT_TRUE(metrics.ok());
  const DenseOracle prior(scene, GasOptions{});
  EXPECT_NEAR(metrics->entropy_nats, prior.Entropy(), kSinglePrecision * prior.Entropy());
  EXPECT_NEAR(metrics->rmse_ppm, prior.Rmse(), kSinglePrecision * prior.Rmse());
  EXPECT_NEAR(metrics->rmse_ppm, metrics->rmse_zero_ppm, kSinglePrecision * prior.Rmse());
}

TEST(Oracle, ForEntropyTakesTheBestCellEachTime) {
  const Scene scene = TinyScene();
  const DenseOracle expected = PlaceByTrying(DenseOracle(scene, GasOptions{}), 5,
                                             [](const DenseOracle& o) { return o.Entropy(); });
  const auto metrics = PlaceReadings(scene, GasOptions{}, 5, OracleAim::kEntropy);
  ASSERT_TRUE(metrics.ok());
  EXPECT_NEAR(metrics->entropy_nats, expected.Entropy(), 1e-3);
  EXPECT_NEAR(metrics->rmse_ppm, expected.Rmse(), 1e-3);
}

TEST(Oracle, ForErrorTakesTheBestCellEachTime) {
  const Scene scene = TinyScene();
  const DenseOracle expected = PlaceByTrying(DenseOracle(scene, GasOptions{}), 5,
                                             [](const DenseOracle& o) { return o.Rmse(); });
  const auto metrics = PlaceReadings(scene, GasOptions{}, 5, OracleAim::kError);
  ASSERT_TRUE(metrics.ok());
  EXPECT_NEAR(metrics->rmse_ppm, expected.Rmse(), 1e-3);
  EXPECT_NEAR(metrics->entropy_nats, expected.Entropy(), 1e-3);
}

TEST(Oracle, RefusesASceneWithoutGas) {
  Scene scene = TinyScene();
  scene.critical_threshold_ppm = 100.0;
  const absl::Status status = PlaceReadings(scene, GasOptions{}, 3, OracleAim::kEntropy).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(status.message().find("tiny"), std::string::npos);
}

}  // namespace oracle_test
}  // namespace plumescout::lab
