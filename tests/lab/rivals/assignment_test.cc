// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/assignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/types/rng.h"

namespace plumescout::lab {
namespace assignment_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Costs = std::vector<std::vector<double>>;

double SumOf(const Costs& costs, const std::vector<std::size_t>& columns) {
  double sum = 0.0;
  for (std::size_t row = 0; row < costs.size(); ++row) sum += costs[row][columns[row]];
  return sum;
}

// The least of all ways to do it.
double LeastSum(const Costs& costs) {
  std::vector<std::size_t> columns(costs.front().size());
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  double least = std::numeric_limits<double>::infinity();
  do {
    least = std::min(least, SumOf(costs, columns));
  } while (std::next_permutation(columns.begin(), columns.end()));
  return least;
}

TEST(LeastAssignment, NobodyGetsNothing) { EXPECT_THAT(LeastAssignment({}), IsEmpty()); }

TEST(LeastAssignment, ARowTakesItsLeast) {
  EXPECT_THAT(LeastAssignment({{3.0, 1.0, 2.0}}), ElementsAre(1u));
}

TEST(LeastAssignment, OneGivesWayIfTheSumIsLess) {
  // Each alone would take column 0: 1 + 10 or 2 + 9 against 2 + 3.
  EXPECT_THAT(LeastAssignment({{1.0, 3.0}, {2.0, 10.0}}), ElementsAre(1u, 0u));
}

TEST(LeastAssignment, IsTheLeastOfAllPermutations) {
  Rng rng(7);
  for (int run = 0; run < 200; ++run) {
    const std::size_t rows = 1 + rng.Below(5);
    const std::size_t columns = rows + rng.Below(3);
    Costs costs(rows, std::vector<double>(columns));
    for (auto& row : costs) {
      // Of few values, so that there are equals.
      for (double& cost : row) cost = static_cast<double>(rng.Below(10));
    }
    const std::vector<std::size_t> taken = LeastAssignment(costs);
    std::vector<std::size_t> sorted = taken;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end()) << run;
    EXPECT_DOUBLE_EQ(SumOf(costs, taken), LeastSum(costs)) << run;
  }
}

}  // namespace assignment_test
}  // namespace plumescout::lab
