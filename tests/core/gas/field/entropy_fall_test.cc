// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/entropy_fall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/gas/field/field_snapshot.h"
#include "tests/core/gas/field/field_case.h"

namespace plumescout {
namespace entropy_fall_test {

using ::plumescout::testing::EngineOf;
using ::plumescout::testing::FieldCase;
using ::plumescout::testing::RandomFieldCase;

constexpr double kPrecision = 7.0;

// A field large enough for subtrees far from what is read, with a weight for each cell.
struct World {
  explicit World(std::uint64_t seed)
      : rng(seed), field(RandomFieldCase(70, 60, 0.2, rng)), snapshot(EngineOf(field).Snapshot()) {
    for (std::size_t i = 0; i < field.cells.size(); ++i) {
      weights.push_back(rng.Below(3) == 0 ? 0.0 : rng.Uniform01());
    }
  }
  // Active ones that lie within a few cells.
  std::vector<std::size_t> NearbyCells(std::size_t count) {
    std::vector<std::size_t> cells;
    const std::size_t corner = rng.Below(60) + 70 * rng.Below(50);
    while (cells.size() < count) {
      const std::size_t cell = corner + rng.Below(10) + 70 * rng.Below(10);
      if (field.cells[cell].active) cells.push_back(cell);
    }
    return cells;
  }

  Rng rng;
  FieldCase field;
  FieldSnapshot snapshot;
  std::vector<double> weights;
};

std::vector<double> BySlot(const FieldSnapshot& snapshot, const std::vector<double>& by_cell) {
  std::vector<double> by_slot(by_cell.size());
  for (std::size_t i = 0; i < by_cell.size(); ++i) by_slot[snapshot.slot(i)] = by_cell[i];
  return by_slot;
}

// Cell by cell.
double FallOf(const World& world, const std::vector<std::size_t>& cells,
              const std::vector<double>& beside_ppm2) {
  const std::vector<double> before = world.snapshot.variance_ppm2();
  const std::vector<double> after = world.snapshot.VarianceIfRead(cells, kPrecision).value();
  double sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!world.field.cells[i].active) continue;
    const double beside = beside_ppm2.empty() ? 0.0 : beside_ppm2[i];
    sum += world.weights[i] * 0.5 * std::log((before[i] + beside) / (after[i] + beside));
  }
  return sum;
}

TEST(EntropyFallTest, AddsUpTheFallOfEveryCell) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    World world(seed);
    const EntropyFall fall = world.snapshot.FallOf(BySlot(world.snapshot, world.weights), {});
    for (const std::size_t count : {1, 4, 11}) {
      const std::vector<std::size_t> cells = world.NearbyCells(count);
      auto columns = world.snapshot.ColumnsIfRead(cells, kPrecision).value();
      ASSERT_TRUE(columns.has_value());
      const double truth = FallOf(world, cells, {});
      EXPECT_NEAR(fall.Of(*columns, {}).value(), truth, 1e-8 * (1.0 + truth));
    }
  }
}

TEST(EntropyFallTest, CountsWhatVariancesHaveBesides) {
  World world(5);
  const std::vector<double> beside_ppm2(world.field.cells.size(), 0.3);
  const std::vector<std::size_t> cells = world.NearbyCells(5);
  auto columns = world.snapshot.ColumnsIfRead(cells, kPrecision).value();
  const double truth = FallOf(world, cells, beside_ppm2);
  EXPECT_NEAR(world.snapshot.FallOf(BySlot(world.snapshot, world.weights), beside_ppm2)
                  .Of(*columns, {})
                  .value(),
              truth, 1e-8 * (1.0 + truth));
}

TEST(EntropyFallTest, IsNeverAboveItsBoundAndOftenNearIt) {
  int bounded = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    World world(seed);
    EntropyFall fall = world.snapshot.FallOf(BySlot(world.snapshot, world.weights), {});
    fall.FindBounds();
    for (std::size_t count = 1; count <= 12; ++count) {
      auto columns = world.snapshot.ColumnsIfRead(world.NearbyCells(count), kPrecision).value();
      const double nats = fall.Of(*columns, {}).value();
      const double most = fall.AtMost(*columns, {}).value();
      EXPECT_GE(most, nats) << "seed " << seed << ", " << count << " readings";
      if (most > nats * (1.0 + 1e-6)) ++bounded;
      EXPECT_LE(most, 2.0 * nats + 1e-6);
    }
  }
  EXPECT_GT(bounded, 10) << "the bound is to spare work";
}

TEST(EntropyFallTest, OfCellsWithoutWeightIsNothing) {
  World world(6);
  const std::vector<double> none(world.weights.size(), 0.0);
  EntropyFall fall = world.snapshot.FallOf(none, {});
  fall.FindBounds();
  auto columns = world.snapshot.ColumnsIfRead(world.NearbyCells(3), kPrecision).value();
  EXPECT_EQ(fall.Of(*columns, {}), 0.0);
  EXPECT_EQ(fall.AtMost(*columns, {}), 0.0);
}

TEST(EntropyFallTest, EndsWhenToldTo) {
  World world(7);
  EntropyFall fall = world.snapshot.FallOf(BySlot(world.snapshot, world.weights), {});
  auto columns = world.snapshot.ColumnsIfRead(world.NearbyCells(3), kPrecision).value();
  EXPECT_EQ(fall.Of(*columns, [] { return true; }), std::nullopt);
  int asked = 0;
  fall.FindBounds([&asked] { return asked++ > 0; });
  EXPECT_EQ(fall.AtMost(*columns, {}), std::nullopt) << "the bounds are not found";
  fall.FindBounds();
  EXPECT_EQ(fall.AtMost(*columns, [] { return true; }), std::nullopt);
  EXPECT_GE(fall.AtMost(*columns, {}).value(), fall.Of(*columns, {}).value());
}

}  // namespace entropy_fall_test
}  // namespace plumescout
