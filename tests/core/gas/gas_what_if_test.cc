// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_what_if.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "absl/status/status.h"
#include "core/gas/coarse_prior.h"
#include "core/gas/gas_map.h"
#include "tests/core/gas/dense_field.h"
#include "tests/support/grid_art.h"

namespace plumescout {
namespace gas_what_if_test {

using ::plumescout::testing::DenseField;
using ::plumescout::testing::DenseReading;
using ::plumescout::testing::GridFromArt;

GasMap MapOf(const Grid<CellState>& states, const std::vector<DenseReading>& readings,
             const GasOptions& options = {}) {
  GasMap map(options);
  for (const DenseReading& r : readings) {
    map.Add(0, states.geometry().Center(r.cell), {r.concentration_ppm, 1.0 / r.precision});
  }
  EXPECT_TRUE(map.Refresh(states, 0).ok());
  return map;
}

TEST(GasWhatIfTest, ForetellsTheVarianceThatReadingsWouldLeave) {
  Rng rng(5);
  const Grid<CellState> states = testing::RandomStates(14, 11, 0.2, rng);
  std::vector<DenseReading> readings = testing::RandomReadings(states, 12, rng);
  const GasMap map = MapOf(states, readings);
  std::vector<Cell> cells;
  for (const DenseReading& r : testing::RandomReadings(states, 16, rng)) {
    cells.push_back(r.cell);
    readings.push_back({r.cell, 4.0, 0.0});
  }
  const auto foretold = map.what_if()->VarianceIfRead(cells, 4.0);
  ASSERT_TRUE(foretold.ok()) << foretold.status();

  const DenseField oracle(states, readings, GasOptions());
  for (std::size_t k = 0; k < oracle.cells().size(); ++k) {
    EXPECT_FLOAT_EQ((*foretold)[oracle.cells()[k]],
                    static_cast<float>(oracle.variance_ppm2()(static_cast<Eigen::Index>(k))));
  }
}

TEST(GasWhatIfTest, StaysAtItsMoment) {
  const Grid<CellState> states = GridFromArt({"....#", "....."});
  GasMap map = MapOf(states, {{{0, 0}, 10.0, 3.0}});
  const std::shared_ptr<const GasWhatIf> before = map.what_if();
  const std::vector<Cell> cells = {{2, 1}};
  const auto foretold = before->VarianceIfRead(cells, 10.0);
  map.Add(0, {0.25, 0.05}, {9.0});
  ASSERT_TRUE(map.Refresh(GridFromArt({"..#.#", "....."}), 0).ok());
  EXPECT_NE(map.what_if(), before);
  const auto again = before->VarianceIfRead(cells, 10.0);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] == CellState::kFree) {
      EXPECT_EQ((*foretold)[i], (*again)[i]);
    }
  }
}

TEST(GasWhatIfTest, CellsThatAreNotFreeTellNothing) {
  const GasMap map = MapOf(GridFromArt({"..#?"}), {});
  const std::vector<Cell> walls = {{2, 0}, {3, 0}};
  const auto foretold = map.what_if()->VarianceIfRead(walls, 10.0);
  ASSERT_TRUE(foretold.ok());
  EXPECT_EQ((*foretold)[(Cell{0, 0})], map.variance_ppm2()[(Cell{0, 0})]);
  EXPECT_TRUE(std::isnan((*foretold)[(Cell{2, 0})]));
}

TEST(GasWhatIfTest, GivenSomeReadingsOthersAreWorthWhatTheyTellBesides) {
  Rng rng(6);
  const Grid<CellState> states = testing::RandomStates(14, 11, 0.2, rng);
  std::vector<DenseReading> readings = testing::RandomReadings(states, 12, rng);
  const GasMap map = MapOf(states, readings);
  std::vector<ForeseenCell> promised;
  for (const DenseReading& r : testing::RandomReadings(states, 7, rng)) {
    promised.push_back({r.cell, 0.5 + rng.Uniform01()});
    readings.push_back({r.cell, promised.back().precision_per_ppm2, 0.0});
  }
  const auto given = map.what_if()->Given(promised);
  ASSERT_TRUE(given.ok()) << given.status();
  const auto expect = [&](const Grid<float>& variance_ppm2) {
    const DenseField oracle(states, readings, GasOptions());
    for (std::size_t k = 0; k < oracle.cells().size(); ++k) {
      EXPECT_FLOAT_EQ(variance_ppm2[oracle.cells()[k]],
                      static_cast<float>(oracle.variance_ppm2()(static_cast<Eigen::Index>(k))));
    }
  };
  expect((*given)->variance_ppm2());
  std::vector<Cell> cells;
  for (const DenseReading& r : testing::RandomReadings(states, 9, rng)) {
    cells.push_back(r.cell);
    readings.push_back({r.cell, 4.0, 0.0});
  }
  expect((*given)->VarianceIfRead(cells, 4.0).value());
}

TEST(GasWhatIfTest, AllCellsOfACoarseCellHearTheReading) {
  GasOptions options;
  options.lattice_factor = 2;
  const GasMap map = MapOf(GridFromArt({"..##", "...."}), {}, options);
  const std::vector<Cell> cells = {{0, 0}};
  const auto foretold = map.what_if()->VarianceIfRead(cells, 10.0);
  ASSERT_TRUE(foretold.ok());
  EXPECT_LT((*foretold)[(Cell{1, 1})], 0.1F + VarianceWithinCell_ppm2(options));
  EXPECT_EQ((*foretold)[(Cell{0, 0})], (*foretold)[(Cell{1, 1})]);
  EXPECT_LT((*foretold)[(Cell{0, 0})], (*foretold)[(Cell{3, 0})]);
}

TEST(GasWhatIfTest, RefusesCellsOffTheMapAndPrecisionsThatAreNone) {
  const GasMap map = MapOf(GridFromArt({".."}), {});
  const std::vector<Cell> inside = {{0, 0}};
  const std::vector<Cell> outside = {{0, 0}, {2, 0}};
  const std::vector<ForeseenCell> promised = {{{2, 0}, 1.0}};
  EXPECT_TRUE(absl::IsInvalidArgument(map.what_if()->Given(promised).status()));
  EXPECT_TRUE(absl::IsInvalidArgument(map.what_if()->VarianceIfRead(outside, 10.0).status()));
  for (const double precision : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                                 std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(absl::IsInvalidArgument(map.what_if()->VarianceIfRead(inside, precision).status()));
  }
}

TEST(GasWhatIfTest, ThereIsNoneBeforeThereIsAFreeCell) {
  GasMap map{GasOptions()};
  EXPECT_EQ(map.what_if(), nullptr);
  ASSERT_TRUE(map.Refresh(GridFromArt({"#?"}), 0).ok());
  EXPECT_EQ(map.what_if(), nullptr);
}

}  // namespace gas_what_if_test
}  // namespace plumescout
