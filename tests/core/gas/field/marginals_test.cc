// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/marginals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/core/gas/field/factor_case.h"

namespace plumescout {
namespace marginals_test {

using ::plumescout::testing::FactorCase;

constexpr double kAnything = std::numeric_limits<double>::max();

std::vector<std::uint8_t> Flags(const FactorCase& c, std::uint8_t flag) {
  return std::vector<std::uint8_t>(c.tree->nodes().size(), flag);
}

// Eliminates all nodes anew and flags those from the owner of `slot` to the root.
std::vector<std::uint8_t> ChangePrecision(FactorCase& c, Slot slot, double precision) {
  std::vector<std::uint8_t> dirty = Flags(c, 0);
  for (std::uint32_t node = c.tree->owner(slot); node != SeparatorTree::kNone;
       node = c.tree->nodes()[node].parent) {
    dirty[node] = 1;
  }
  c.cells.precision[slot] = precision;
  FrontBuilder builder(*c.tree, testing::DefaultField().prior);
  c.factor.Eliminate(dirty, c.cells, builder);
  return dirty;
}

TEST(MarginalsTest, EqualTheDenseInverse) {
  const FactorCase c(1);
  Marginals marginals(*c.tree);
  marginals.Descend(c.factor, Flags(c, 1), {});
  for (Slot slot = 0; slot < c.tree->cells(); ++slot) {
    if (!c.IsActive(slot)) {
      EXPECT_TRUE(std::isnan(marginals.mean_ppm()[slot]));
      EXPECT_TRUE(std::isnan(marginals.variance_ppm2()[slot]));
      continue;
    }
    const Eigen::Index v = c.Variable(slot);
    EXPECT_NEAR(marginals.mean_ppm()[slot], c.mean_ppm(v), 1e-9);
    EXPECT_NEAR(marginals.variance_ppm2()[slot] / c.inverse(v, v), 1.0, 1e-9);
  }
}

TEST(MarginalsTest, StayAsTheyAreIfNothingHasChanged) {
  const FactorCase c(2);
  Marginals marginals(*c.tree);
  marginals.Descend(c.factor, Flags(c, 1), {});
  const FieldShift error = marginals.Descend(c.factor, Flags(c, 0), {}).error;
  EXPECT_EQ(error.mean_ppm, 0.0);
  EXPECT_EQ(error.covariance_ppm2, 0.0);
}

TEST(MarginalsTest, LeaveSubtreesAloneWithinTheToleranceAndSayHowFarTheyAreOff) {
  FactorCase c(3);
  Marginals marginals(*c.tree);
  marginals.Descend(c.factor, Flags(c, 1), {});
  const Slot slot = c.RandomActiveSlots(1)[0];
  const std::vector<std::uint8_t> dirty = ChangePrecision(c, slot, 500.0);
  const FieldShift error = marginals.Descend(c.factor, dirty, {kAnything, kAnything}).error;
  Marginals exact(*c.tree);
  exact.Descend(c.factor, Flags(c, 1), {});
  double worst_mean = 0.0;
  double worst_variance = 0.0;
  for (Slot i = 0; i < c.tree->cells(); ++i) {
    if (!c.IsActive(i)) continue;
    const double mean = std::abs(marginals.mean_ppm()[i] - exact.mean_ppm()[i]);
    const double variance = std::abs(marginals.variance_ppm2()[i] - exact.variance_ppm2()[i]);
    worst_mean = std::max(worst_mean, mean);
    worst_variance = std::max(worst_variance, variance);
    if (dirty[c.tree->owner(i)] == 0) continue;
    EXPECT_EQ(mean, 0.0);
    EXPECT_EQ(variance, 0.0);
  }
  EXPECT_GT(worst_variance, 0.0);
  EXPECT_LE(worst_mean, error.mean_ppm * (1.0 + 1e-9));
  EXPECT_LE(worst_variance, error.covariance_ppm2 * (1.0 + 1e-9));
}

TEST(MarginalsTest, DoNotForgetOldChangesWhenNewOnesAreSmall) {
  // Many changes, each within the tolerance, must be noticed once their sum is beyond it.
  FactorCase c(4);
  Marginals marginals(*c.tree);
  marginals.Descend(c.factor, Flags(c, 1), {});
  const Slot slot = c.RandomActiveSlots(1)[0];
  constexpr FieldShift kTolerance = {1e-2, 1e-3};
  for (int k = 1; k <= 200; ++k) {
    const std::vector<std::uint8_t> dirty = ChangePrecision(c, slot, 0.05 * k);
    const FieldShift error = marginals.Descend(c.factor, dirty, kTolerance).error;
    EXPECT_LE(error.covariance_ppm2, kTolerance.covariance_ppm2);
  }
  Marginals exact(*c.tree);
  exact.Descend(c.factor, Flags(c, 1), {});
  for (Slot i = 0; i < c.tree->cells(); ++i) {
    if (!c.IsActive(i)) continue;
    EXPECT_NEAR(marginals.mean_ppm()[i], exact.mean_ppm()[i], kTolerance.mean_ppm);
    EXPECT_NEAR(marginals.variance_ppm2()[i], exact.variance_ppm2()[i], kTolerance.covariance_ppm2);
  }
}

// What the fields should be, from scratch.
void ExpectNear(const FactorCase& c, const Marginals& marginals, const FieldShift& error) {
  constexpr double kRounding = 1e-10;
  Marginals exact(*c.tree);
  exact.Descend(c.factor, Flags(c, 1), {});
  for (Slot i = 0; i < c.tree->cells(); ++i) {
    if (!c.IsActive(i)) continue;
    EXPECT_NEAR(marginals.mean_ppm()[i], exact.mean_ppm()[i], error.mean_ppm + kRounding);
    EXPECT_NEAR(marginals.variance_ppm2()[i], exact.variance_ppm2()[i],
                error.covariance_ppm2 + kRounding);
  }
}

void Hear(FactorCase& c, const FieldReading& reading, const FieldShift& limit,
          Marginals& marginals) {
  const std::vector<PathStep> steps = c.factor.StepsFrom(reading.slot);
  EXPECT_TRUE(marginals.Hear(c.factor, reading, steps, limit));
  c.factor.AddReading(steps, reading.precision, reading.weighted_deviation);
}

TEST(MarginalsTest, HearReadingsExactlyIfNothingMayBeOwed) {
  FactorCase c(5);
  Marginals marginals(*c.tree);
  marginals.Descend(c.factor, Flags(c, 1), {});
  for (const Slot slot : c.RandomActiveSlots(8)) Hear(c, {slot, 9.0, 90.0}, {}, marginals);
  EXPECT_EQ(marginals.owed().mean_ppm, 0.0);
  EXPECT_EQ(marginals.owed().covariance_ppm2, 0.0);
  ExpectNear(c, marginals, {});
}

TEST(MarginalsTest, OweNoMoreThanTheySayForReadingsTheyPassOver) {
  FactorCase c(6);
  Marginals marginals(*c.tree);
  marginals.Descend(c.factor, Flags(c, 1), {});
  FieldShift limit;
  for (const Slot slot : c.RandomActiveSlots(12)) {
    limit = limit + FieldShift{0.5, 5e-3};
    Hear(c, {slot, 9.0, 90.0}, limit, marginals);
    EXPECT_TRUE(marginals.owed().IsWithin(limit));
    ExpectNear(c, marginals, marginals.owed());
  }
  EXPECT_GT(marginals.owed().mean_ppm, 0.0) << "nothing was passed over";
}

TEST(MarginalsTest, AreExactInACellThatIsRead) {
  // However far off they were: after a precise reading that would be a large share of the variance.
  FactorCase c(9);
  Marginals marginals(*c.tree);
  marginals.Descend(c.factor, Flags(c, 1), {});
  const auto dirty = ChangePrecision(c, c.RandomActiveSlots(1)[0], 500.0);
  marginals.Descend(c.factor, dirty, {kAnything, kAnything});
  constexpr double kPrecision = 1e6;
  for (const Slot slot : c.RandomActiveSlots(20)) {
    if (dirty[c.tree->owner(slot)] != 0) continue;
    Hear(c, {slot, kPrecision, 0.0}, {}, marginals);
    const double exact = c.factor.StepsFrom(slot).back().variance_ppm2;
    EXPECT_NEAR(marginals.variance_ppm2()[slot] / exact, 1.0, 1e-9);
  }
}

TEST(MarginalsTest, KnowAtTheNextDescentWhatTheyHaveHeard) {
  // What the factor learns of readings that all nodes have heard moves no boundary: everything off
  // their path is kept.
  FactorCase c(7);
  Marginals marginals(*c.tree);
  marginals.Descend(c.factor, Flags(c, 1), {});
  const Slot slot = c.RandomActiveSlots(1)[0];
  Hear(c, {slot, 9.0, 0.0}, {}, marginals);
  const auto dirty = ChangePrecision(c, slot, c.cells.precision[slot] + 9.0);
  const FieldShift error = marginals.Descend(c.factor, dirty, {kAnything, kAnything}).error;
  EXPECT_LE(error.mean_ppm, 1e-9);
  EXPECT_LE(error.covariance_ppm2, 1e-10);
}

TEST(MarginalsTest, PayAtTheNextDescentWhatTheyOwe) {
  FactorCase c(8);
  Marginals marginals(*c.tree);
  marginals.Descend(c.factor, Flags(c, 1), {});
  const Slot slot = c.RandomActiveSlots(1)[0];
  Hear(c, {slot, 9.0, 0.0}, {kAnything, kAnything}, marginals);
  ASSERT_GT(marginals.owed().covariance_ppm2, 1e-4);
  const auto dirty = ChangePrecision(c, slot, c.cells.precision[slot] + 9.0);
  constexpr FieldShift kTolerance = {1e-5, 1e-6};
  EXPECT_TRUE(marginals.Descend(c.factor, dirty, kTolerance).error.IsWithin(kTolerance));
  EXPECT_EQ(marginals.owed().covariance_ppm2, 0.0);
  ExpectNear(c, marginals, kTolerance);
}

}  // namespace marginals_test
}  // namespace plumescout
