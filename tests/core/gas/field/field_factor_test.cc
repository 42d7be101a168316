// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_factor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "tests/core/gas/field/factor_case.h"

namespace plumescout {
namespace field_factor_test {

using ::plumescout::testing::FactorCase;

TEST(FieldFactorTest, KnowsMeanAndVarianceOfACellAtTheEndOfItsSteps) {
  const FactorCase c(2);
  for (const Slot slot : c.RandomActiveSlots(20)) {
    const std::vector<PathStep> steps = c.factor.StepsFrom(slot);
    const Eigen::Index v = c.Variable(slot);
    EXPECT_NEAR(steps.back().mean_ppm, c.mean_ppm(v), 1e-9);
    EXPECT_NEAR(steps.back().variance_ppm2, c.inverse(v, v), 1e-10);
  }
}

TEST(FieldFactorTest, HearsReadingsAsIfItHadBeenEliminatedWithThem) {
  FactorCase c(5);
  FactorCase truth(5);
  std::vector<std::uint8_t> all(c.tree->nodes().size(), 1);
  FrontBuilder builder(*c.tree, testing::DefaultField().prior);
  constexpr double kPrecision = 12.0;
  constexpr double kDeviation = 240.0;
  for (const Slot slot : c.RandomActiveSlots(6)) {
    c.factor.AddReading(c.factor.StepsFrom(slot), kPrecision, kDeviation);
    truth.cells.precision[slot] += kPrecision;
    truth.cells.weighted_deviation[slot] += kDeviation;
  }
  truth.factor.Eliminate(all, truth.cells, builder);
  for (std::size_t node = 0; node < all.size(); ++node) {
    const Front& front = c.factor.front(node);
    const Front& expected = truth.factor.front(node);
    for (std::size_t i = 0; i < front.own; ++i) {
      EXPECT_NEAR(front.offset_ppm[i], expected.offset_ppm[i], 1e-10);
      EXPECT_NEAR(front.weight_sums[i], expected.weight_sums[i], 1e-12);
    }
    for (std::size_t i = 0; i < front.covariance.size(); ++i) {
      EXPECT_NEAR(front.covariance[i], expected.covariance[i], 1e-12);
    }
    for (std::size_t i = 0; i < front.weights.size(); ++i) {
      EXPECT_NEAR(front.weights[i], expected.weights[i], 1e-12);
    }
  }
}

TEST(FieldFactorTest, ForeseesWhatItWouldBeWithSuchReadings) {
  for (const std::size_t count : {1, 3, 8, 21}) {
    FactorCase c(count);
    FactorCase truth(count);
    std::vector<Slot> slots = c.RandomActiveSlots(count);
    slots.push_back(slots.front());
    std::sort(slots.begin(), slots.end());
    std::vector<double> noise_ppm2;
    for (const Slot slot : slots) {
      noise_ppm2.push_back(c.rng.Uniform(0.02, 3.0));
      truth.cells.precision[slot] += 1.0 / noise_ppm2.back();
    }
    const FieldFactor before = c.factor;
    const ReadingPaths paths(c.factor, slots);
    c.factor.AddForeseen(paths, noise_ppm2);
    FrontBuilder builder(*c.tree, testing::DefaultField().prior);
    const std::vector<std::uint8_t> all(c.tree->nodes().size(), 1);
    truth.factor.Eliminate(all, truth.cells, builder);
    const auto expect_near = [](const std::vector<double>& are, const std::vector<double>& were) {
      ASSERT_EQ(are.size(), were.size());
      for (std::size_t i = 0; i < are.size(); ++i) EXPECT_NEAR(are[i], were[i], 1e-12);
    };
    for (std::size_t node = 0; node < all.size(); ++node) {
      const Front& front = c.factor.front(node);
      const Front& expected = truth.factor.front(node);
      EXPECT_EQ(&front == &before.front(node), paths.StepAt(node) == nullptr);
      expect_near(front.covariance, expected.covariance);
      expect_near(front.weights, expected.weights);
      expect_near(front.weight_sums, expected.weight_sums);
    }
  }
}

TEST(FieldFactorTest, LeavesACopyAsItWasWhenPathsAreEliminatedAgain) {
  FactorCase c(3);
  const Slot slot = c.RandomActiveSlots(1)[0];
  const FieldFactor copy = c.factor;
  std::vector<std::uint8_t> dirty(c.tree->nodes().size(), 0);
  for (std::uint32_t node = c.tree->owner(slot); node != SeparatorTree::kNone;
       node = c.tree->nodes()[node].parent) {
    dirty[node] = 1;
  }
  c.cells.precision[slot] += 100.0;
  FrontBuilder builder(*c.tree, testing::DefaultField().prior);
  c.factor.Eliminate(dirty, c.cells, builder);
  const double variance = c.inverse(c.Variable(slot), c.Variable(slot));
  EXPECT_NEAR(copy.StepsFrom(slot).back().variance_ppm2, variance, 1e-10);
  EXPECT_NEAR(c.factor.StepsFrom(slot).back().variance_ppm2, variance / (1.0 + 100.0 * variance),
              1e-10);
}

TEST(FieldFactorTest, SharesTheNodesOffTheChangedPath) {
  FactorCase c(4);
  const FieldFactor copy = c.factor;
  std::vector<std::uint8_t> dirty(c.tree->nodes().size(), 0);
  dirty.back() = 1;
  FrontBuilder builder(*c.tree, testing::DefaultField().prior);
  c.factor.Eliminate(dirty, c.cells, builder);
  const std::size_t root = dirty.size() - 1;
  EXPECT_NE(&copy.front(root), &c.factor.front(root));
  for (std::size_t node = 0; node < root; ++node) {
    EXPECT_EQ(&copy.front(node), &c.factor.front(node));
  }
}

void ExpectPlacesInParents(const FieldFactor& factor) {
  const std::vector<SeparatorTree::Node>& nodes = factor.tree().nodes();
  for (std::size_t node = 0; node + 1 < nodes.size(); ++node) {
    const std::vector<Slot>& above = factor.front(nodes[node].parent).cells;
    std::vector<Slot> found;
    for (const std::uint32_t place : factor.PlacesInParent(node)) found.push_back(above[place]);
    const std::span<const Slot> boundary = factor.front(node).boundary_cells();
    EXPECT_EQ(found, std::vector<Slot>(boundary.begin(), boundary.end()));
  }
}

TEST(FieldFactorTest, KnowsThePlacesOfBoundariesInTheFrontsAbove) {
  FactorCase c(7);
  ExpectPlacesInParents(c.factor);
  c.factor.AddReading(c.factor.StepsFrom(c.RandomActiveSlots(1)[0]), 3.0, 1.0);
  ExpectPlacesInParents(c.factor);
}

// The fronts below stay as they are, and so do their boundaries.
TEST(FieldFactorTest, KnowsThePlacesOnceAnotherCellOfTheRootIsActive) {
  FactorCase c(8);
  const SeparatorTree::Node& root = c.tree->nodes().back();
  FrontBuilder builder(*c.tree, testing::DefaultField().prior);
  std::vector<std::uint8_t> dirty(c.tree->nodes().size(), 0);
  dirty.back() = 1;
  int activated = 0;
  for (Slot slot = root.first; slot < root.end; ++slot) {
    if (c.IsActive(slot)) continue;
    c.cells.active[slot] = 1;  // without factors to its neighbours
    c.factor.Eliminate(dirty, c.cells, builder);
    ExpectPlacesInParents(c.factor);
    ++activated;
  }
  EXPECT_GT(activated, 0);
}

}  // namespace field_factor_test
}  // namespace plumescout
