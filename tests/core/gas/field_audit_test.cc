// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field_audit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "core/gas/gas_map.h"
#include "tests/core/gas/dense_field.h"
#include "tests/core/gas/gas_map_peer.h"
#include "tests/support/grid_art.h"

namespace plumescout {
namespace field_audit_test {

using ::plumescout::testing::GridFromArt;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// Moves the map's corner so that the anchor lies inside it.
Grid<CellState> Grown(const Grid<CellState>& states, int cells) {
  GridGeometry geometry = states.geometry();
  geometry.origin_x_m -= cells * geometry.resolution_m;
  geometry.origin_y_m -= cells * geometry.resolution_m;
  geometry.width += cells;
  geometry.height += cells;
  Grid<CellState> grown(geometry, CellState::kFree);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Cell cell = states.geometry().CellAtIndex(i);
    grown[Cell{cell.x + cells, cell.y + cells}] = states[i];
  }
  return grown;
}

// A map that has grown, with readings of several precisions and ages.
std::unique_ptr<GasMap> Sampled(const GasOptions& options, std::uint64_t seed) {
  auto map = std::make_unique<GasMap>(options);
  Rng rng(seed);
  Grid<CellState> states = testing::RandomStates(21, 17, 0.25, rng);
  EXPECT_TRUE(map->Refresh(states, 0).ok());
  for (int k = 0; k < 40; ++k) {
    const std::int64_t time_ns = k * kSecond_ns / 2;
    if (k == 20) states = Grown(states, 3);
    const Point2 position =
        states.geometry().Center(states.geometry().CellAtIndex(rng.Below(states.size())));
    map->Add(time_ns, position, {rng.Uniform(300.0, 900.0), k % 7 == 0 ? 0.01 : 0.0});
    if (map->adoption_due(time_ns)) {
      EXPECT_TRUE(map->Adopt().ok());
    }
    EXPECT_TRUE(map->Refresh(states, time_ns).ok());
    if (map->epoch_due(time_ns)) {
      EXPECT_TRUE(map->BeginEpoch(time_ns).ok());
    }
  }
  if (map->epoch() != nullptr) {
    EXPECT_TRUE(map->Adopt().ok());
  }
  return map;
}

class FieldAuditTest : public ::testing::TestWithParam<int> {
 protected:
  static GasOptions Options(double half_life_s) {
    GasOptions options;
    options.lattice_factor = GetParam();
    options.ageing_half_life_s = half_life_s;
    options.background_mean_ppm = 400.0;
    return options;
  }
};

TEST_P(FieldAuditTest, AFieldThatIsRightIsWithinItsCertificate) {
  for (const double half_life_s : {0.0, 120.0}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const auto map = Sampled(Options(half_life_s), seed);
      const auto inputs = map->MakeAudit();
      ASSERT_NE(inputs, nullptr);
      const auto finding = RunAudit(*inputs);
      ASSERT_TRUE(finding.ok()) << finding.status();
      EXPECT_TRUE(finding->certified) << finding->mean_ppm << ", " << finding->variance_ratio;
      EXPECT_LE(finding->mean_ppm, 1e-5 * 600.0);
      EXPECT_LE(finding->variance_ratio, 1e-5);
      EXPECT_GT(finding->mean_ppm, 0.0) << "no two computations round alike";
    }
  }
}

TEST_P(FieldAuditTest, AFieldThatWasMisledIsFoundAndAnEpochMendsIt) {
  const auto map = Sampled(Options(0.0), 4);
  const auto before = map->MakeAudit();
  std::size_t index = 0;
  while (std::isnan(before->mean_ppm[index])) ++index;
  GasMapPeer::Mislead(*map, before->lattice.CellAt(index), 50.0);
  const auto found = RunAudit(*map->MakeAudit());
  ASSERT_TRUE(found.ok());
  EXPECT_FALSE(found->certified);
  EXPECT_GT(found->mean_ppm, 1.0);
  EXPECT_GT(found->variance_ratio, 0.01);

  ASSERT_TRUE(map->BeginEpoch(20 * kSecond_ns).ok());
  EXPECT_EQ(map->MakeAudit(), nullptr) << "readings may be merged meanwhile";
  ASSERT_TRUE(map->Adopt().ok());
  const auto mended = RunAudit(*map->MakeAudit());
  ASSERT_TRUE(mended.ok());
  EXPECT_TRUE(mended->certified) << mended->mean_ppm << ", " << mended->variance_ratio;
}

INSTANTIATE_TEST_SUITE_P(LatticeFactors, FieldAuditTest, ::testing::Values(1, 2, 3));

TEST(FieldAudit, FindsTheSmallestWrongMeanAndVarianceThatAreNotCertified) {
  const auto map = Sampled({}, 5);
  const auto right = map->MakeAudit();
  std::size_t index = 0;
  while (std::isnan(right->mean_ppm[index])) ++index;
  AuditInputs wrong = *right;
  wrong.mean_ppm[index] += 0.02;  // of some 900 ppm
  EXPECT_FALSE(RunAudit(wrong)->certified);
  EXPECT_NEAR(RunAudit(wrong)->mean_ppm, 0.02, 0.01);
  wrong = *right;
  wrong.variance_ppm2[index] *= 1.0001;
  EXPECT_FALSE(RunAudit(wrong)->certified);
  EXPECT_NEAR(RunAudit(wrong)->variance_ratio, 1e-4, 2e-5);
  wrong.certified_variance_ratio = 2e-4;
  EXPECT_TRUE(RunAudit(wrong)->certified);
}

TEST(FieldAudit, ACellThatOnlyOneOfTheTwoKnowsIsBeyondMeasure) {
  GasMap map{GasOptions()};
  ASSERT_TRUE(map.Refresh(GridFromArt({"..#"}), 0).ok());
  const auto right = map.MakeAudit();
  AuditInputs wrong = *right;
  wrong.states[Cell{2, 0}] = CellState::kFree;
  EXPECT_TRUE(std::isinf(RunAudit(wrong)->variance_ratio));
  EXPECT_FALSE(RunAudit(wrong)->certified);
  wrong = *right;
  wrong.states[Cell{1, 0}] = CellState::kOccupied;
  EXPECT_TRUE(std::isinf(RunAudit(wrong)->variance_ratio));
  EXPECT_FALSE(RunAudit(wrong)->certified);
}

TEST(FieldAudit, WhatCannotBeComputedIsAnError) {
  GasMap map{GasOptions()};
  ASSERT_TRUE(map.Refresh(GridFromArt({".."}), 0).ok());
  AuditInputs broken = *map.MakeAudit();
  broken.options.prior_precision_per_ppm2 = std::nan("");
  EXPECT_FALSE(RunAudit(broken).ok());
}

TEST(FieldAudit, NothingIsAuditedWithoutAField) {
  GasMap map{GasOptions()};
  EXPECT_EQ(map.MakeAudit(), nullptr);
  EXPECT_FALSE(map.audit_due());
}

TEST(FieldAudit, IsDueAfterTheFirstEpochAndThenPeriodically) {
  GasOptions options;
  options.audit_period_epochs = 3;
  GasMap map(options);
  options.audit_period_epochs = 0;
  GasMap never(options);
  for (GasMap* each : {&map, &never}) ASSERT_TRUE(each->Refresh(GridFromArt({".."}), 0).ok());
  std::vector<int> due;
  for (int epoch = 1; epoch <= 7; ++epoch) {
    for (GasMap* each : {&map, &never}) {
      ASSERT_TRUE(each->BeginEpoch(0).ok());
      ASSERT_TRUE(each->Adopt().ok());
    }
    if (map.audit_due()) due.push_back(epoch);
    EXPECT_FALSE(never.audit_due());
  }
  EXPECT_EQ(due, (std::vector<int>{1, 4, 7}));
}

}  // namespace field_audit_test
}  // namespace plumescout
