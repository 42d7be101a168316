// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_inputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/status/status.h"
#include "tests/support/grid_art.h"

namespace plumescout {
namespace gas_inputs_test {

using ::plumescout::testing::GridFromArt;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

GasOptions Options(int lattice_factor, double half_life_s = 0.0) {
  GasOptions options = PublishedGasOptions();
  options.lattice_factor = lattice_factor;
  options.ageing_half_life_s = half_life_s;
  return options;
}

TEST(GasInputsTest, SaysWhichCellsHaveNews) {
  GasInputs inputs(Options(1));
  EXPECT_THAT(*inputs.Update(GridFromArt({"..#"}), 0), ElementsAre(GasCell{0, 0}, GasCell{1, 0}));
  EXPECT_THAT(*inputs.Update(GridFromArt({"..#"}), 0), IsEmpty());
  inputs.Add(0, {0.15, 0.05}, {7.0});
  EXPECT_THAT(*inputs.Update(GridFromArt({"..#"}), 0), ElementsAre(GasCell{1, 0}));
  EXPECT_EQ(inputs.Of({1, 0}), (CellInput{true, 10.0, 70.0, true, true}));
  EXPECT_FALSE(inputs.Of({2, 0}).active);
}

TEST(GasInputsTest, RectHoldsAllThatEverWasFree) {
  GasInputs inputs(Options(1));
  EXPECT_TRUE(inputs.rect().empty());
  ASSERT_TRUE(inputs.Update(GridFromArt({"?..?"}), 0).ok());
  ASSERT_TRUE(inputs.Update(GridFromArt({"?#.."}), 0).ok());
  EXPECT_EQ(inputs.rect().min.x, 1);
  EXPECT_EQ(inputs.rect().end.x, 4);
}

TEST(GasInputsTest, CoarseCellAddsUpTheReadingsOfItsCells) {
  GasInputs inputs(Options(2));
  for (const double x_m : {0.05, 0.15, 0.25}) inputs.Add(0, {x_m, 0.05}, {1.0});
  ASSERT_TRUE(inputs.Update(GridFromArt({"....", "...."}), 0).ok());
  EXPECT_EQ(inputs.Of({0, 0}), (CellInput{true, 20.0, 20.0, true, false}));
  EXPECT_EQ(inputs.Of({1, 0}), (CellInput{true, 10.0, 10.0, false, false}));
}

TEST(GasInputsTest, ADoorIsNewsForTheCellsThatItLinks) {
  GasInputs inputs(Options(2));
  ASSERT_TRUE(inputs.Update(GridFromArt({".#..", ".#.."}), 0).ok());
  EXPECT_FALSE(inputs.Of({0, 0}).linked_east);
  EXPECT_THAT(*inputs.Update(GridFromArt({".#..", "...."}), 0), ::testing::Contains(GasCell{0, 0}));
  EXPECT_TRUE(inputs.Of({0, 0}).linked_east);
  // Opened from the east side, the cell whose link it is has not changed itself.
  ASSERT_TRUE(inputs.Update(GridFromArt({"..#.", "..#."}), 0).ok());
  EXPECT_FALSE(inputs.Of({0, 0}).linked_east);
  EXPECT_THAT(*inputs.Update(GridFromArt({"..#.", "...."}), 0), ::testing::Contains(GasCell{0, 0}));
  EXPECT_TRUE(inputs.Of({0, 0}).linked_east);
}

TEST(GasInputsTest, AgedEvidenceIsTheSameBeforeAndAfterAgeing) {
  GasInputs inputs(Options(2, 60.0));
  for (int k = 0; k < 50; ++k) {
    inputs.Add(k * kSecond_ns, {0.05 + 0.1 * (k % 4), 0.05 + 0.1 * (k % 2)},
               {1.0 + k, 0.1 + k % 3});
  }
  ASSERT_TRUE(inputs.Update(GridFromArt({"....", "...."}), 0).ok());
  const auto aged = inputs.EvidenceAsOf(90 * kSecond_ns);
  EXPECT_THAT(inputs.AgeTo(90 * kSecond_ns), ElementsAre(GasCell{0, 0}, GasCell{1, 0}));
  ASSERT_EQ(aged.size(), 2U);
  for (const auto& [cell, evidence] : aged) {
    EXPECT_EQ(inputs.Of(cell).precision, evidence.precision);
    EXPECT_EQ(inputs.Of(cell).weighted_deviation, evidence.weighted_deviation);
  }
}

TEST(GasInputsTest, AgesAloneWhatAnEpochWouldAgeTooLate) {
  GasInputs inputs(Options(1, 60.0));
  const Grid<CellState> states = GridFromArt({"..."});
  inputs.Add(0, {0.05, 0.05}, {7.0, 0.001});  // 1.7 of itself more per second
  inputs.Add(0, {0.15, 0.05}, {7.0, 0.1});
  ASSERT_TRUE(inputs.Update(states, 0).ok());
  EXPECT_THAT(*inputs.Update(states, 6 * kSecond_ns), ElementsAre(GasCell{0, 0}));
  EXPECT_NEAR(inputs.Of({0, 0}).precision, 1.0 / (0.001 + 0.01), 1e-9);
  EXPECT_NEAR(inputs.Of({1, 0}).precision, 10.0, 1e-12);
  EXPECT_NEAR(inputs.watch().Error(6 * kSecond_ns), 0.1, 1e-12);
  EXPECT_THAT(*inputs.Update(states, 7 * kSecond_ns), ElementsAre(GasCell{0, 0}, GasCell{1, 0}));
}

TEST(GasInputsTest, AWholeLatticeIsToldWhatEachCellIs) {
  for (const int factor : {1, 2}) {
    GasInputs inputs(Options(factor, 60.0));
    for (int k = 0; k < 40; ++k) {
      inputs.Add(k * kSecond_ns, {0.05 + 0.1 * (k % 5), 0.05 + 0.1 * (k % 3)},
                 {1.0 + k, k % 4 == 0 ? 0.001 : 0.1});
    }
    ASSERT_TRUE(inputs.Update(GridFromArt({".#...", ".....", "..#.#"}), 20 * kSecond_ns).ok());
    const GasLattice lattice{-1, -2, 8, 9};
    const std::vector<CellInput> all = inputs.On(lattice);
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], inputs.Of(lattice.CellAt(i)));
  }
}

TEST(GasInputsTest, RefusesAnotherLatticeAndChangesNothing) {
  GasInputs inputs(Options(1));
  ASSERT_TRUE(inputs.Update(GridFromArt({".."}), 0).ok());
  inputs.Add(0, {0.05, 0.05}, {7.0});
  EXPECT_TRUE(absl::IsInvalidArgument(inputs.Update(GridFromArt({".#"}, 0.2), 0).status()));
  EXPECT_TRUE(inputs.Of({1, 0}).active);
  EXPECT_EQ(inputs.counters().waiting, 1);
}

}  // namespace gas_inputs_test
}  // namespace plumescout
