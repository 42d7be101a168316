// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_epoch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumescout {
namespace gas_epoch_test {

constexpr GasLattice kLattice{0, 0, 12, 9};
const FieldOptions kOptions{
    {.prior_precision_per_ppm2 = 3.0, .background_precision_per_ppm2 = 0.001}, {}, 16};

// A map with a wall and some readings, and the fields of an engine that has just been made.
EpochInputs Inputs() {
  EpochInputs inputs;
  inputs.time_ns = 7;
  inputs.options = kOptions;
  inputs.lattice = kLattice;
  for (std::size_t i = 0; i < kLattice.size(); ++i) {
    CellInput input{.active = i % 12 != 5 || i > 80};
    if (input.active && i % 7 == 0) {
      input.precision = 10.0;
      input.weighted_deviation = 10.0 * static_cast<double>(i);
    }
    inputs.cells.push_back(input);
  }
  const FieldEngine live(12, 9, inputs.cells, kOptions);
  for (std::size_t i = 0; i < kLattice.size(); ++i) {
    inputs.mean_ppm.push_back(live.mean_ppm(i));
    inputs.variance_ppm2.push_back(live.variance_ppm2(i));
  }
  return inputs;
}

TEST(GasEpochTest, FieldThatIsExactHasNotDrifted) {
  GasEpoch epoch(Inputs());
  EXPECT_FALSE(epoch.done());
  epoch.Recompute();
  EXPECT_TRUE(epoch.done());
  EXPECT_EQ(epoch.time_ns(), 7);
  EXPECT_EQ(epoch.drift()->mean_ppm, 0.0);
  EXPECT_EQ(epoch.drift()->variance_ratio, 0.0);
}

TEST(GasEpochTest, DriftIsTheLargestDifference) {
  EpochInputs inputs = Inputs();
  inputs.mean_ppm[3] += 0.25;
  inputs.mean_ppm[4] -= 0.5;
  inputs.variance_ppm2[8] *= 1.01;
  inputs.mean_ppm[5] = std::numeric_limits<double>::quiet_NaN();  // the wall
  GasEpoch epoch(std::move(inputs));
  epoch.Recompute();
  EXPECT_NEAR(epoch.drift()->mean_ppm, 0.5, 1e-9);
  EXPECT_NEAR(epoch.drift()->variance_ratio, 0.01, 1e-9);
}

TEST(GasEpochTest, AFieldThatIsNotANumberHasDriftedBeyondMeasure) {
  EpochInputs inputs = Inputs();
  inputs.variance_ppm2[8] = std::numeric_limits<double>::quiet_NaN();
  GasEpoch epoch(std::move(inputs));
  epoch.Recompute();
  EXPECT_TRUE(std::isinf(epoch.drift()->variance_ratio));
}

TEST(GasEpochTest, TakesTheAgedEvidence) {
  EpochInputs inputs = Inputs();
  CellInput aged = inputs.cells[14];
  aged.precision = 1.0;
  aged.weighted_deviation = 14.0;
  inputs.aged.push_back({14, aged});
  GasEpoch epoch(std::move(inputs));
  epoch.Recompute();
  EXPECT_EQ(epoch.drift()->mean_ppm, 0.0) << "ageing is not drift";
  const std::unique_ptr<FieldEngine> engine = epoch.TakeEngine();
  EXPECT_EQ(engine->input(14), aged);

  EpochInputs expected = Inputs();
  expected.cells[14] = aged;
  const FieldEngine fresh(12, 9, expected.cells, kOptions);
  for (std::size_t i = 0; i < kLattice.size(); ++i) {
    if (!expected.cells[i].active) continue;
    EXPECT_NEAR(engine->mean_ppm(i), fresh.mean_ppm(i), 1e-5 * 110.0);
    EXPECT_NEAR(engine->variance_ppm2(i), fresh.variance_ppm2(i), 1e-5 * fresh.variance_ppm2(i));
  }
}

TEST(GasEpochTest, EvidenceThatIsNoneIsSaid) {
  EpochInputs inputs = Inputs();
  CellInput aged = inputs.cells[14];
  aged.precision = std::numeric_limits<double>::quiet_NaN();
  inputs.aged.push_back({14, aged});
  GasEpoch epoch(std::move(inputs));
  epoch.Recompute();
  EXPECT_FALSE(epoch.done());
  EXPECT_EQ(epoch.failure().code(), absl::StatusCode::kInvalidArgument);
}

TEST(GasEpochTest, CellsThatNoReadingsGiveAreSaid) {
  EpochInputs inputs = Inputs();
  inputs.cells[14].precision = -10.0;
  GasEpoch epoch(std::move(inputs));
  epoch.Recompute();
  EXPECT_FALSE(epoch.done());
  EXPECT_EQ(epoch.failure().code(), absl::StatusCode::kInvalidArgument);
}

TEST(GasEpochTest, RecomputesOnce) {
  GasEpoch epoch(Inputs());
  epoch.Recompute();
  epoch.Recompute();
  EXPECT_NE(epoch.TakeEngine(), nullptr);
}

}  // namespace gas_epoch_test
}  // namespace plumescout
