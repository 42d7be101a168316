// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/rng.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace plumescout {
namespace rng_test {

constexpr int kDraws = 100'000;

TEST(Rng, DrawsThePublishedSequence) {
  // xoshiro256** seeded with splitmix64 from 0.
  Rng rng(0);
  EXPECT_EQ(rng.Next(), 0x99EC5F36CB75F2B4ULL);
  EXPECT_EQ(rng.Next(), 0xBF6E1F784956452AULL);
  EXPECT_EQ(rng.Next(), 0x1A5F849D4933E6E0ULL);
  EXPECT_EQ(rng.Next(), 0x6AA594F1262D2D2CULL);
}

TEST(Rng, DrawsDifferentlyFromDifferentSeeds) { EXPECT_NE(Rng(1).Next(), Rng(2).Next()); }

TEST(Rng, DrawsUniformlyBelowOne) {
  Rng rng(1);
  std::array<int, 10> bins{};
  for (int i = 0; i < kDraws; ++i) {
    const double draw = rng.Uniform01();
    ASSERT_GE(draw, 0.0);
    ASSERT_LT(draw, 1.0);
    ++bins[static_cast<std::size_t>(draw * 10.0)];
  }
  // Binomial: five standard deviations of sqrt(n * 0.1 * 0.9).
  for (const int count : bins) EXPECT_NEAR(count, kDraws / 10, 5.0 * std::sqrt(0.09 * kDraws));
}

TEST(Rng, DrawsWithinARange) {
  Rng rng(2);
  for (int i = 0; i < kDraws; ++i) {
    const double draw = rng.Uniform(-3.0, 5.0);
    ASSERT_GE(draw, -3.0);
    ASSERT_LT(draw, 5.0);
  }
}

TEST(Rng, DrawsEveryNumberBelowABoundEquallyOften) {
  Rng rng(3);
  std::array<int, 7> bins{};
  for (int i = 0; i < kDraws; ++i) ++bins.at(rng.Below(7));
  const double share = 1.0 / 7.0;
  for (const int count : bins) {
    EXPECT_NEAR(count, share * kDraws, 5.0 * std::sqrt(share * (1.0 - share) * kDraws));
  }
}

TEST(Rng, DrawsNothingButZeroBelowOne) {
  Rng rng(4);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(rng.Below(1), 0U);
}

TEST(Rng, DrawsGaussiansOfMeanZeroAndVarianceOne) {
  Rng rng(5);
  double sum = 0.0;
  double squares = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double draw = rng.Gaussian();
    sum += draw;
    squares += draw * draw;
    beyond_two += std::abs(draw) > 2.0 ? 1 : 0;
  }
  // Five standard deviations of the mean, of the mean square (variance 2) and of a count.
  const double root = std::sqrt(static_cast<double>(kDraws));
  EXPECT_NEAR(sum / kDraws, 0.0, 5.0 / root);
  EXPECT_NEAR(squares / kDraws, 1.0, 5.0 * std::sqrt(2.0) / root);
  const double tails = std::erfc(2.0 / std::sqrt(2.0));
  EXPECT_NEAR(beyond_two, tails * kDraws, 5.0 * std::sqrt(tails * kDraws));
}

}  // namespace rng_test
}  // namespace plumescout
