// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/front_builder.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "tests/core/gas/field/factor_case.h"

namespace plumescout {
namespace front_builder_test {

using ::plumescout::testing::FactorCase;

Eigen::MatrixXd Part(const FactorCase& c, const Eigen::MatrixXd& matrix, std::span<const Slot> rows,
                     std::span<const Slot> columns) {
  Eigen::MatrixXd part(rows.size(), columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      part(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          matrix(c.Variable(rows[i]), c.Variable(columns[j]));
    }
  }
  return part;
}

// The distribution of own cells given the boundary, out of the joint one.
TEST(FrontBuilderTest, HoldsTheConditionalDistributionOfItsCells) {
  const FactorCase c(1);
  for (std::size_t node = 0; node < c.tree->nodes().size(); ++node) {
    const Front& front = c.factor.front(node);
    const Eigen::MatrixXd rs = Part(c, c.inverse, front.boundary_cells(), front.own_cells());
    const Eigen::MatrixXd rr = Part(c, c.inverse, front.boundary_cells(), front.boundary_cells());
    const Eigen::MatrixXd ss = Part(c, c.inverse, front.own_cells(), front.own_cells());
    const Eigen::MatrixXd weights = rs.transpose() * rr.inverse();
    const Eigen::MatrixXd covariance = ss - weights * rs;
    std::vector<double> scratch;
    const double* const front_weights = front.Weights(scratch);
    for (std::size_t i = 0; i < front.own; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      double mean = front.offset_ppm[i];
      for (std::size_t j = 0; j < front.boundary(); ++j) {
        const double weight = front_weights[j * front.own + i];
        EXPECT_NEAR(weight, weights(row, static_cast<Eigen::Index>(j)), 1e-9);
        mean += weight * c.mean_ppm(c.Variable(front.boundary_cells()[j]));
      }
      EXPECT_NEAR(mean, c.mean_ppm(c.Variable(front.cells[i])), 1e-9);
      for (std::size_t j = 0; j <= i; ++j) {
        EXPECT_NEAR(front.covariance_column(j)[i - j],
                    covariance(row, static_cast<Eigen::Index>(j)), 1e-9);
      }
    }
  }
}

TEST(FrontBuilderTest, WeighsItsBoundaryByAtMostOne) {
  const FactorCase c(2);
  for (std::size_t node = 0; node < c.tree->nodes().size(); ++node) {
    const Front& front = c.factor.front(node);
    std::vector<double> scratch;
    const double* const weights = front.Weights(scratch);
    for (std::size_t i = 0; i < front.own; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < front.boundary(); ++j) {
        const double weight = weights[j * front.own + i];
        EXPECT_GE(weight, 0.0);
        sum += weight;
      }
      EXPECT_LE(sum, 1.0 + 1e-12);
    }
  }
}

TEST(FrontBuilderTest, TouchesNobodyAcrossAWall) {
  // Two rooms, the wall between them as separator: neither has a boundary.
  std::vector<std::uint8_t> active(20 * 9, 1);
  for (std::size_t y = 0; y < 9; ++y) active[y * 20 + 10] = 0;
  const SeparatorTree tree(20, 9, active);
  std::vector<CellInput> inputs(180);
  for (std::size_t i = 0; i < 180; ++i) inputs[i].active = active[i] != 0;
  const FieldCells cells(tree, inputs);
  FieldFactor factor(std::make_shared<SeparatorTree>(tree));
  FrontBuilder builder(tree, testing::DefaultField().prior);
  factor.Eliminate(std::vector<std::uint8_t>(tree.nodes().size(), 1), cells, builder);
  EXPECT_TRUE(factor.front(tree.nodes().size() - 1).cells.empty());
  for (const std::uint32_t child : tree.nodes().back().children) {
    EXPECT_EQ(factor.front(child).boundary(), 0u);
    EXPECT_FALSE(factor.front(child).cells.empty());
  }
}

}  // namespace front_builder_test
}  // namespace plumescout
