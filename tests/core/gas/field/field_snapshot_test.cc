// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_snapshot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/gas/field/field_engine.h"
#include "tests/core/gas/field/field_case.h"

namespace plumescout {
namespace field_snapshot_test {

using ::plumescout::testing::DefaultField;
using ::plumescout::testing::EngineOf;
using ::plumescout::testing::FieldCase;
using ::plumescout::testing::RandomChanges;
using ::plumescout::testing::RandomFieldCase;
using ::plumescout::testing::RandomReading;

constexpr double kExact = 1e-9;
constexpr double kPrecision = 7.0;

// The dense variance after readings in `cells`.
void ExpectVariances(FieldCase c, const std::vector<std::size_t>& cells,
                     const std::vector<double>& variance_ppm2) {
  for (const std::size_t cell : cells) c.cells[cell].precision += kPrecision;
  const testing::DenseTruth dense = c.Dense();
  ASSERT_EQ(variance_ppm2.size(), c.cells.size());
  for (std::size_t i = 0; i < c.cells.size(); ++i) {
    if (!c.cells[i].active) {
      EXPECT_TRUE(std::isnan(variance_ppm2[i]));
      continue;
    }
    const double truth = dense.covariance()(dense.variable(i), dense.variable(i));
    EXPECT_NEAR(variance_ppm2[i] / truth, 1.0, kExact) << "cell " << i;
  }
}

std::vector<std::size_t> RandomCells(const FieldCase& c, int count, Rng& rng) {
  std::vector<std::size_t> cells;
  for (int k = 0; k < count; ++k) cells.push_back(rng.Below(c.cells.size()));
  return cells;
}

TEST(FieldSnapshotTest, ForeseesTheDenseVarianceOfAnyNumberOfReadings) {
  Rng rng(1);
  const FieldCase c = RandomFieldCase(19, 23, 0.25, rng);
  const FieldSnapshot snapshot = EngineOf(c).Snapshot();
  for (const int count : {0, 1, 2, 5, 16, 33}) {
    const std::vector<std::size_t> cells = RandomCells(c, count, rng);
    const auto variance = snapshot.VarianceIfRead(cells, kPrecision);
    ASSERT_TRUE(variance.ok());
    ExpectVariances(c, cells, *variance);
  }
}

TEST(FieldSnapshotTest, KnowsTheReadingsSinceTheLastPass) {
  Rng rng(2);
  FieldCase c = RandomFieldCase(19, 23, 0.25, rng);
  FieldEngine engine = EngineOf(c);
  for (int k = 0; k < 6; ++k) {
    const std::vector<CellChange> changes = RandomReading(c, rng);
    c.Apply(changes);
    ASSERT_TRUE(engine.Apply(changes).ok());
  }
  const std::vector<std::size_t> cells = RandomCells(c, 7, rng);
  const auto variance = engine.Snapshot().VarianceIfRead(cells, kPrecision);
  ASSERT_TRUE(variance.ok());
  ExpectVariances(c, cells, *variance);
}

TEST(FieldSnapshotTest, CountsACellTwiceThatIsReadTwice) {
  Rng rng(3);
  const FieldCase c = RandomFieldCase(12, 12, 0.0, rng);
  const std::vector<std::size_t> cells = {40, 40};
  const auto variance = EngineOf(c).Snapshot().VarianceIfRead(cells, kPrecision);
  ASSERT_TRUE(variance.ok());
  ExpectVariances(c, cells, *variance);
}

TEST(FieldSnapshotTest, DoesNotChangeWhenTheEngineGoesOn) {
  Rng rng(4);
  const FieldCase before = RandomFieldCase(19, 23, 0.25, rng);
  FieldEngine engine = EngineOf(before);
  const FieldSnapshot snapshot = engine.Snapshot();
  FieldCase c = before;
  for (int k = 0; k < 20; ++k) {
    const std::vector<CellChange> changes =
        k % 2 == 0 ? RandomReading(c, rng) : RandomChanges(c, 6, 0.25, rng);
    c.Apply(changes);
    ASSERT_TRUE(engine.Apply(changes).ok());
  }
  const std::vector<std::size_t> cells = RandomCells(before, 5, rng);
  const auto variance = snapshot.VarianceIfRead(cells, kPrecision);
  ASSERT_TRUE(variance.ok());
  ExpectVariances(before, cells, *variance);
}

TEST(FieldSnapshotTest, LeavesOutNoMoreThanTheToleranceOfItsEngine) {
  constexpr double kShare = 1e-2;
  Rng rng(7);
  const FieldCase c = RandomFieldCase(19, 23, 0.25, rng);
  FieldOptions options = DefaultField();
  options.tolerance.variance_share = kShare;
  const std::vector<std::size_t> cells = RandomCells(c, 2, rng);
  const auto exact = EngineOf(c).Snapshot().VarianceIfRead(cells, kPrecision);
  const auto pruned = EngineOf(c, options).Snapshot().VarianceIfRead(cells, kPrecision);
  ASSERT_TRUE(exact.ok() && pruned.ok());
  double most = 0.0;
  for (std::size_t i = 0; i < c.cells.size(); ++i) {
    if (!c.cells[i].active) continue;
    const double excess = (*pruned)[i] / (*exact)[i] - 1.0;
    EXPECT_GE(excess, -kExact);
    most = std::max(most, excess);
  }
  EXPECT_LE(most, kShare);
  EXPECT_GT(most, kExact);  // something is left out
}

TEST(FieldSnapshotTest, OutlivesItsEngine) {
  Rng rng(5);
  const FieldCase c = RandomFieldCase(12, 12, 0.2, rng);
  auto engine = std::make_unique<FieldEngine>(EngineOf(c));
  const FieldSnapshot snapshot = engine->Snapshot();
  engine.reset();
  const auto variance = snapshot.VarianceIfRead(std::vector<std::size_t>{3, 50}, kPrecision);
  ASSERT_TRUE(variance.ok());
  ExpectVariances(c, {3, 50}, *variance);
}

TEST(FieldSnapshotTest, GivenReadingsItIsThatOfTheFieldThatHasHeardThem) {
  Rng rng(8);
  FieldCase c = RandomFieldCase(19, 23, 0.25, rng);
  const FieldSnapshot now = EngineOf(c).Snapshot();
  std::vector<ForeseenReading> promised;
  for (const std::size_t cell : RandomCells(c, 21, rng)) {
    promised.push_back({cell, 0.1 + 20.0 * rng.Uniform01()});
    c.cells[cell].precision += promised.back().precision;
  }
  const auto given = now.Given(promised);
  ASSERT_TRUE(given.ok()) << given.status();
  ExpectVariances(c, {}, given->variance_ppm2());
  const std::vector<std::size_t> cells = RandomCells(c, 9, rng);
  const auto then = given->VarianceIfRead(cells, kPrecision);
  ASSERT_TRUE(then.ok());
  ExpectVariances(c, cells, *then);
  const auto given_twice = given->Given(std::vector<ForeseenReading>{{cells[0], kPrecision}});
  ASSERT_TRUE(given_twice.ok());
  ExpectVariances(c, {cells[0]}, given_twice->variance_ppm2());
}

TEST(FieldSnapshotTest, GivenNothingItIsTheSame) {
  Rng rng(9);
  const FieldCase c = RandomFieldCase(12, 12, 0.2, rng);
  const FieldSnapshot now = EngineOf(c).Snapshot();
  const auto given = now.Given({});
  ASSERT_TRUE(given.ok());
  ExpectVariances(c, {}, given->variance_ppm2());
  ExpectVariances(c, {}, now.variance_ppm2());
}

TEST(FieldSnapshotTest, IsGivenNothingOnceToldToStop) {
  Rng rng(10);
  const FieldCase c = RandomFieldCase(12, 12, 0.2, rng);
  std::vector<ForeseenReading> promised;
  for (const std::size_t cell : RandomCells(c, 9, rng)) promised.push_back({cell, kPrecision});
  const auto given = EngineOf(c).Snapshot().Given(promised, [] { return true; });
  EXPECT_EQ(given.status().code(), absl::StatusCode::kCancelled);
}

TEST(FieldSnapshotTest, RefusesCellsBeyondTheLatticeAndSenselessPrecisions) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Rng rng(6);
  const FieldSnapshot snapshot = EngineOf(RandomFieldCase(10, 10, 0.2, rng)).Snapshot();
  const auto code = [&](std::size_t cell, double precision) {
    return snapshot.VarianceIfRead(std::vector<std::size_t>{cell}, precision).status().code();
  };
  EXPECT_EQ(code(100, 1.0), absl::StatusCode::kInvalidArgument);
  for (const double precision : {0.0, -1.0, kNaN, 2.0 * kMaxCellPrecision}) {
    EXPECT_EQ(code(0, precision), absl::StatusCode::kInvalidArgument);
    const std::vector<ForeseenReading> promised = {{0, precision}};
    EXPECT_EQ(snapshot.Given(promised).status().code(), absl::StatusCode::kInvalidArgument);
  }
}

}  // namespace field_snapshot_test
}  // namespace plumescout
