// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/posterior.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "tests/core/gas/dense_field.h"
#include "tests/support/grid_art.h"

namespace plumescout::lab {
namespace posterior_test {

using ::plumescout::testing::DenseField;
using ::plumescout::testing::DenseReading;
using ::plumescout::testing::GridFromArt;

Posterior SolveField(const Grid<CellState>& states, const std::vector<DenseReading>& readings,
                     const GasOptions& options) {
  const GmrfGraph graph(states);
  std::vector<Evidence> evidence(static_cast<std::size_t>(graph.variables()));
  for (const DenseReading& r : readings) {
    evidence[ToSize(graph.At(r.cell))] +=
        {r.precision, r.precision * (r.concentration_ppm - options.background_mean_ppm)};
  }
  return PosteriorSolver().Solve(graph, evidence, options).value();
}

// Condition number of H below 8 lambda_p / lambda_d = 24000, so both solutions are good to about
// 24000 * 2^-53 * n < 1e-9 of the largest value.
constexpr double kRelativeError = 1e-9;

void ExpectExact(const Grid<CellState>& states, const std::vector<DenseReading>& readings,
                 const GasOptions& options) {
  const DenseField oracle(states, readings, options);
  const Posterior posterior = SolveField(states, readings, options);
  ASSERT_EQ(posterior.mean_ppm.size(), oracle.cells().size());
  const double scale_ppm = 1.0 + oracle.mean_ppm().cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < posterior.mean_ppm.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(posterior.mean_ppm[i], oracle.mean_ppm()(k), kRelativeError * scale_ppm);
    EXPECT_NEAR(posterior.variance_ppm2[i] / oracle.variance_ppm2()(k), 1.0, kRelativeError);
  }
}

TEST(PosteriorTest, EqualsTheDenseInverseOnRandomMaps) {
  Rng rng(101);
  for (const double blocked_share : {0.0, 0.1, 0.3, 0.45, 0.7}) {
    const Grid<CellState> states = testing::RandomStates(15, 13, blocked_share, rng);
    ExpectExact(states, testing::RandomReadings(states, 12, rng), GasOptions());
  }
}

TEST(PosteriorTest, EqualsTheDenseInverseInRoomsWithADoorAndAClosedPocket) {
  const Grid<CellState> states = GridFromArt({"...#....#..",  //
                                              "...#....#..",  //
                                              "........###",  //
                                              "...#.......",  //
                                              "?..#......."});
  ExpectExact(
      states,
      {{{0, 4}, 10.0, 30.0}, {{10, 3}, 10.0, 5.0}, {{10, 3}, 4.0, 9.0}, {{5, 1}, 10.0, 0.0}},
      GasOptions());
}

TEST(PosteriorTest, EqualsTheDenseInverseWithTheParametersOfInformativePathPlanning) {
  GasOptions options;
  options.prior_precision_per_ppm2 = 0.5;  // F_p and F_o of [IPP] section IV
  options.background_mean_ppm = 400.0;
  Rng rng(102);
  const Grid<CellState> states = testing::RandomStates(12, 14, 0.25, rng);
  ExpectExact(states, testing::RandomReadings(states, 20, rng), options);
}

TEST(PosteriorTest, WithoutReadingsIsTheBackground) {
  GasOptions options;
  options.background_mean_ppm = 400.0;
  const Posterior posterior = SolveField(GridFromArt({"....", ".#.."}), {}, options);
  for (const double mean_ppm : posterior.mean_ppm) EXPECT_EQ(mean_ppm, 400.0);
}

TEST(PosteriorTest, OfOneLonelyCellIsTheWeightedMean) {
  GasOptions options;
  options.background_precision_per_ppm2 = 2.0;
  options.background_mean_ppm = 1.0;
  const Posterior posterior = SolveField(GridFromArt({"."}), {{{0, 0}, 6.0, 9.0}}, options);
  EXPECT_DOUBLE_EQ(posterior.mean_ppm[0], (2.0 * 1.0 + 6.0 * 9.0) / 8.0);
  EXPECT_DOUBLE_EQ(posterior.variance_ppm2[0], 1.0 / 8.0);
}

TEST(PosteriorTest, MinimisesTheEnergy) {
  // [IPP] Eq. (5): at the mean, readings and neighbours of each cell balance.
  const Grid<CellState> states = GridFromArt({"..", ".."});
  const GasOptions options;
  const std::vector<double> m = SolveField(states, {{{0, 0}, 10.0, 20.0}}, options).mean_ppm;
  const double lambda_p = options.prior_precision_per_ppm2;
  const double lambda_d = options.background_precision_per_ppm2;
  EXPECT_NEAR(10.0 * (m[0] - 20.0) + lambda_d * m[0] + lambda_p * (2 * m[0] - m[1] - m[2]), 0.0,
              1e-11);
  EXPECT_NEAR(lambda_d * m[3] + lambda_p * (2 * m[3] - m[1] - m[2]), 0.0, 1e-11);
}

TEST(PosteriorTest, IsEmptyWithoutFreeCells) {
  EXPECT_TRUE(SolveField(GridFromArt({"##", "??"}), {}, GasOptions()).mean_ppm.empty());
  EXPECT_TRUE(SolveField(Grid<CellState>(), {}, GasOptions()).mean_ppm.empty());
}

TEST(PosteriorTest, RefusesEvidenceThatIsNotFinite) {
  const GmrfGraph graph(GridFromArt({"."}));
  const std::vector<Evidence> evidence = {{std::numeric_limits<double>::infinity(), 0.0}};
  EXPECT_EQ(PosteriorSolver().Solve(graph, evidence, GasOptions()).status().code(),
            absl::StatusCode::kInvalidArgument);
}

}  // namespace posterior_test
}  // namespace plumescout::lab
