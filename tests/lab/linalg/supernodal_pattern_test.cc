// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/linalg/supernodal_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "tests/core/linalg/dense_oracle.h"

namespace plumescout::lab {
namespace supernodal_pattern_test {

std::size_t Unsigned(int index) { return static_cast<std::size_t>(index); }

class SupernodalPatternTest : public ::testing::Test {
 protected:
  SupernodalPatternTest() {
    Rng rng(3);
    for (const double share : {0.0, 0.02, 0.1, 0.6}) {
      matrices_.push_back(testing::RandomPositiveDefinite(60, share, rng));
    }
    matrices_.push_back(testing::GridLaplacian(17, 13, 0.1));
    for (const SymmetricMatrix& matrix : matrices_) {
      patterns_.push_back(AnalyzePattern(matrix).value());
    }
  }
  std::vector<SymmetricMatrix> matrices_;
  std::vector<SupernodalPattern> patterns_;
};

TEST_F(SupernodalPatternTest, OrdersEveryUnknownOnce) {
  for (const SupernodalPattern& pattern : patterns_) {
    std::vector<int> order = pattern.order;
    std::sort(order.begin(), order.end());
    for (int i = 0; i < pattern.n; ++i) EXPECT_EQ(order[Unsigned(i)], i);
  }
}

TEST_F(SupernodalPatternTest, PanelsBeginWithTheirOwnColumnsAndAscend) {
  for (const SupernodalPattern& pattern : patterns_) {
    for (std::size_t s = 0; s < pattern.parent.size(); ++s) {
      const auto begin = pattern.row.begin() + static_cast<std::ptrdiff_t>(pattern.first_row[s]);
      const auto end = pattern.row.begin() + static_cast<std::ptrdiff_t>(pattern.first_row[s + 1]);
      EXPECT_EQ(*begin, pattern.first_column[s]);
      EXPECT_EQ(begin[static_cast<std::ptrdiff_t>(pattern.columns(s)) - 1],
                pattern.first_column[s + 1] - 1);
      EXPECT_TRUE(std::adjacent_find(begin, end, std::greater_equal<>()) == end);
    }
  }
}

TEST_F(SupernodalPatternTest, EveryRowBelowIsFoundInTheParent) {
  for (const SupernodalPattern& pattern : patterns_) {
    for (std::size_t s = 0; s < pattern.parent.size(); ++s) {
      if (pattern.parent[s] < 0) continue;
      EXPECT_GT(pattern.parent[s], static_cast<int>(s));
      const std::size_t base = pattern.first_row[Unsigned(pattern.parent[s])];
      for (std::size_t k = pattern.first_row[s] + pattern.columns(s); k < pattern.first_row[s + 1];
           ++k) {
        EXPECT_EQ(pattern.row[base + Unsigned(pattern.parent_row[k])], pattern.row[k]);
      }
    }
  }
}

TEST_F(SupernodalPatternTest, ChildrenAreOnTopWhenTheirParentComes) {
  for (const SupernodalPattern& pattern : patterns_) {
    std::vector<int> stack;
    for (int s = 0; s < pattern.supernodes(); ++s) {
      for (int child = 0; child < pattern.child_count[Unsigned(s)]; ++child) {
        ASSERT_FALSE(stack.empty());
        EXPECT_EQ(pattern.parent[Unsigned(stack.back())], s);
        stack.pop_back();
      }
      if (pattern.parent[Unsigned(s)] >= 0) stack.push_back(s);
    }
    EXPECT_TRUE(stack.empty());
  }
}

TEST_F(SupernodalPatternTest, EveryEntryOfTheMatrixHasItsPlaceInAPanel) {
  for (std::size_t m = 0; m < matrices_.size(); ++m) {
    const SupernodalPattern& pattern = patterns_[m];
    std::set<int> sources;
    for (std::size_t s = 0; s < pattern.parent.size(); ++s) {
      const std::set<int> rows(
          pattern.row.begin() + static_cast<std::ptrdiff_t>(pattern.first_row[s]),
          pattern.row.begin() + static_cast<std::ptrdiff_t>(pattern.first_row[s + 1]));
      for (int e = pattern.first_entry[Unsigned(pattern.first_column[s])];
           e < pattern.first_entry[Unsigned(pattern.first_column[s + 1])]; ++e) {
        EXPECT_TRUE(rows.contains(pattern.entry[Unsigned(e)].row));
        sources.insert(pattern.entry[Unsigned(e)].source);
      }
    }
    EXPECT_EQ(sources.size(), matrices_[m].row.size());
  }
}

TEST_F(SupernodalPatternTest, SaysNothingOnStandardOutput) {
  ::testing::internal::CaptureStdout();
  const auto pattern = AnalyzePattern(matrices_.back());
  EXPECT_TRUE(pattern.ok());
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

}  // namespace supernodal_pattern_test
}  // namespace plumescout::lab
