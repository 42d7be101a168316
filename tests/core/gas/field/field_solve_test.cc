// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_solve.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "tests/core/gas/field/factor_case.h"

namespace plumescout {
namespace field_solve_test {

using ::plumescout::testing::FactorCase;

Eigen::VectorXd OnActive(const FactorCase& c, const std::vector<double>& by_slot) {
  Eigen::VectorXd values(c.inverse.rows());
  for (Slot slot = 0; slot < by_slot.size(); ++slot) {
    if (c.IsActive(slot)) values(c.Variable(slot)) = by_slot[slot];
  }
  return values;
}

TEST(FieldSolveTest, MultipliesByTheDenseInverse) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    FactorCase c(seed);
    std::vector<double> right_side(c.tree->cells());
    for (double& value : right_side) value = c.rng.Uniform(-2.0, 5.0);
    const std::vector<double> solution = SolveField(c.factor, right_side);
    const Eigen::VectorXd truth = c.inverse * OnActive(c, right_side);
    for (Slot slot = 0; slot < solution.size(); ++slot) {
      const double expected = c.IsActive(slot) ? truth(c.Variable(slot)) : 0.0;
      EXPECT_NEAR(solution[slot], expected, 1e-9 * (1.0 + truth.cwiseAbs().maxCoeff()));
    }
  }
}

TEST(FieldSolveTest, HearsReadingsThatTheFactorWasToldOneByOne) {
  FactorCase c(4);
  const Slot slot = c.RandomActiveSlots(1)[0];
  c.factor.AddReading(c.factor.StepsFrom(slot), 7.0, 0.0);
  Eigen::MatrixXd hessian = c.inverse.inverse();
  hessian(c.Variable(slot), c.Variable(slot)) += 7.0;
  std::vector<double> right_side(c.tree->cells(), 1.0);
  const std::vector<double> solution = SolveField(c.factor, right_side);
  const Eigen::VectorXd truth = hessian.ldlt().solve(OnActive(c, right_side));
  for (Slot s = 0; s < solution.size(); ++s) {
    if (!c.IsActive(s)) continue;
    EXPECT_NEAR(solution[s], truth(c.Variable(s)), 1e-9 * (1.0 + truth.cwiseAbs().maxCoeff()));
  }
}

TEST(FieldSolveTest, NothingComesOfNothing) {
  const FactorCase c(5);
  for (const double value : SolveField(c.factor, std::vector<double>(c.tree->cells(), 0.0))) {
    EXPECT_EQ(value, 0.0);
  }
}

}  // namespace field_solve_test
}  // namespace plumescout
