// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/reading_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "tests/core/gas/field/factor_case.h"

namespace plumescout {
namespace reading_paths_test {

using ::plumescout::testing::FactorCase;

// One of them twice now and then.
std::vector<Slot> SomeSlots(const FactorCase& c, std::size_t count) {
  std::vector<Slot> slots = c.RandomActiveSlots(count);
  if (count % 2 == 0) slots.push_back(slots.front());
  std::sort(slots.begin(), slots.end());
  return slots;
}

double Among(const ReadingPaths::Step& step, std::size_t i, std::size_t j) {
  return step.among[std::min(i, j) * step.stride() + std::max(i, j)];
}

TEST(ReadingPathsTest, HoldTheInverseBetweenTheirCellsAtTheRoot) {
  for (const std::size_t count : {1, 2, 9, 30}) {
    const FactorCase c(count);
    const std::vector<Slot> slots = SomeSlots(c, count);
    const ReadingPaths paths(c.factor, slots);
    ASSERT_EQ(paths.cells(), slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i) {
      for (std::size_t j = 0; j < slots.size(); ++j) {
        const double truth = c.inverse(c.Variable(slots[i]), c.Variable(slots[j]));
        EXPECT_NEAR(Among(paths.steps().back(), i, j), truth, 1e-10);
      }
    }
  }
}

TEST(ReadingPathsTest, AreTheSameInTheMemoryOfOthers) {
  const FactorCase c(7);
  std::optional<ReadingPaths> used;
  for (const std::size_t count : {3, 30, 1, 12, 30}) {
    const std::vector<Slot> slots = SomeSlots(c, count);
    const ReadingPaths fresh(c.factor, slots);
    ReadingPaths paths(c.factor, slots, {}, std::move(used));
    ASSERT_EQ(paths.steps().size(), fresh.steps().size());
    for (std::size_t i = 0; i < fresh.steps().size(); ++i) {
      const ReadingPaths::Step& step = paths.steps()[i];
      const ReadingPaths::Step& truth = fresh.steps()[i];
      ASSERT_EQ(step.node, truth.node);
      ASSERT_EQ(step.first, truth.first);
      ASSERT_EQ(step.cells, truth.cells);
      const std::size_t size =
          (c.factor.front(step.node).cells.size() + step.cells) * step.stride();
      EXPECT_TRUE(std::equal(step.own, step.own + size, truth.own)) << "padding included";
    }
    used = std::move(paths);
  }
}

TEST(ReadingPathsTest, AreTheStepsOfEachCell) {
  const FactorCase c(7);
  const std::vector<Slot> slots = SomeSlots(c, 24);
  const ReadingPaths paths(c.factor, slots);
  std::size_t steps = 0;
  for (std::size_t j = 0; j < slots.size(); ++j) {
    for (const PathStep& truth : c.factor.StepsFrom(slots[j])) {
      const ReadingPaths::Step* const step = paths.StepAt(truth.node);
      ASSERT_NE(step, nullptr);
      ASSERT_TRUE(step->first <= j && j < step->first + step->cells);
      const std::size_t at = j - step->first;
      EXPECT_NEAR(Among(*step, at, at), truth.variance_ppm2, 1e-12);
      for (std::size_t i = 0; i < truth.own.size(); ++i) {
        EXPECT_NEAR(step->own[i * step->stride() + at], truth.own[i], 1e-12);
      }
      for (std::size_t i = 0; i < truth.boundary.size(); ++i) {
        EXPECT_NEAR(step->boundary[i * step->stride() + at], truth.boundary[i], 1e-12);
      }
      ++steps;
    }
  }
  std::size_t cells = 0;
  for (const ReadingPaths::Step& step : paths.steps()) cells += step.cells;
  EXPECT_EQ(cells, steps);
  const auto before = [](const auto& a, const auto& b) { return a.node >= b.node; };
  EXPECT_EQ(std::adjacent_find(paths.steps().begin(), paths.steps().end(), before),
            paths.steps().end());
}

TEST(ReadingPathsTest, KnowNothingOfNodesOffTheWay) {
  const FactorCase c(3);
  const ReadingPaths paths(c.factor, std::vector<Slot>{c.RandomActiveSlots(1)[0]});
  const std::size_t on_the_way = paths.steps().size();
  std::size_t found = 0;
  for (std::size_t node = 0; node < c.tree->nodes().size(); ++node) {
    if (paths.StepAt(node) != nullptr) ++found;
  }
  EXPECT_EQ(found, on_the_way);
  EXPECT_LT(found, c.tree->nodes().size());
}

TEST(ReadingPathsTest, EndWhenToldTo) {
  const FactorCase c(4);
  int asked = 0;
  const ReadingPaths paths(c.factor, SomeSlots(c, 30), [&asked] { return asked++ > 0; });
  EXPECT_EQ(asked, 2);
}

}  // namespace reading_paths_test
}  // namespace plumescout
