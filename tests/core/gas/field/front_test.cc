// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/front.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "tests/core/gas/field/factor_case.h"

namespace plumescout {
namespace front_test {

using ::plumescout::testing::FactorCase;

Eigen::VectorXd RandomVector(std::size_t size, Rng& rng) {
  Eigen::VectorXd vector(static_cast<Eigen::Index>(size));
  for (double& value : vector) value = rng.Uniform(0.0, 1.0);
  return vector;
}

std::span<const double> SpanOf(const Eigen::VectorXd& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

Eigen::MatrixXd DenseCovariance(const Front& front) {
  const auto size = static_cast<Eigen::Index>(front.own);
  Eigen::MatrixXd covariance(size, size);
  for (std::size_t j = 0; j < front.own; ++j) {
    for (std::size_t i = j; i < front.own; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const auto column = static_cast<Eigen::Index>(j);
      covariance(row, column) = covariance(column, row) = front.covariance_column(j)[i - j];
    }
  }
  return covariance;
}

Eigen::MatrixXd DenseWeights(const Front& front) {
  std::vector<double> scratch;
  return Eigen::Map<const Eigen::MatrixXd>(front.Weights(scratch),
                                           static_cast<Eigen::Index>(front.own),
                                           static_cast<Eigen::Index>(front.boundary()));
}

TEST(FrontTest, MultipliesByItsCovarianceAndItsWeights) {
  const FactorCase c(1);
  Rng rng(1);
  for (std::size_t node = 0; node < c.tree->nodes().size(); ++node) {
    const Front& front = c.factor.front(node);
    const Eigen::VectorXd own = RandomVector(front.own, rng);
    const Eigen::VectorXd boundary = RandomVector(front.boundary(), rng);
    Eigen::VectorXd sum = own;
    std::vector<double> scratch;
    front.AddCovariance(SpanOf(own), sum.data());
    front.AddWeighted(SpanOf(boundary), scratch, sum.data());
    const Eigen::VectorXd expected =
        own + DenseCovariance(front) * own + DenseWeights(front) * boundary;
    EXPECT_LE((sum - expected).cwiseAbs().sum(), 1e-10);
    Eigen::VectorXd transposed = boundary;
    front.AddTransposed(SpanOf(own), scratch, transposed.data());
    const Eigen::VectorXd on_boundary = boundary + DenseWeights(front).transpose() * own;
    EXPECT_LE((transposed - on_boundary).cwiseAbs().sum(), 1e-10);
    const Eigen::VectorXd weight_sums =
        DenseWeights(front) * Eigen::VectorXd::Ones(static_cast<Eigen::Index>(front.boundary()));
    for (std::size_t i = 0; i < front.own; ++i) {
      EXPECT_NEAR(front.weight_sums[i], weight_sums(static_cast<Eigen::Index>(i)), 1e-12);
    }
  }
}

TEST(FrontTest, ConditionsAStepOnItsBoundary) {
  const FactorCase c(2);
  Rng rng(2);
  for (std::size_t node = 0; node < c.tree->nodes().size(); ++node) {
    const Front& front = c.factor.front(node);
    const Eigen::VectorXd weights = RandomVector(front.cells.size(), rng);
    const auto own = weights.head(static_cast<Eigen::Index>(front.own));
    PathStep step;
    step.mean_ppm = 3.0;
    step.variance_ppm2 = 0.5;
    Condition(front, SpanOf(weights), step);
    const Eigen::VectorXd covariance = DenseCovariance(front) * own;
    const Eigen::VectorXd boundary = weights.tail(static_cast<Eigen::Index>(front.boundary())) +
                                     DenseWeights(front).transpose() * own;
    const Eigen::Map<const Eigen::VectorXd> offset(front.offset_ppm.data(), own.size());
    EXPECT_NEAR(step.variance_ppm2, 0.5 + own.dot(covariance), 1e-10);
    EXPECT_NEAR(step.mean_ppm, 3.0 + own.dot(offset), 1e-9);
    for (std::size_t i = 0; i < step.own.size(); ++i) {
      EXPECT_NEAR(step.own[i], covariance(static_cast<Eigen::Index>(i)), 1e-10);
    }
    for (std::size_t i = 0; i < step.boundary.size(); ++i) {
      EXPECT_NEAR(step.boundary[i], boundary(static_cast<Eigen::Index>(i)), 1e-10);
    }
  }
}

}  // namespace front_test
}  // namespace plumescout
