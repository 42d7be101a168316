// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/unread_discount.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/gas/gas_map.h"

namespace plumescout {
namespace unread_discount_test {

TEST(UnreadDiscountTest, TakesMoreTheLessIsKnown) {
  GasOptions gas;
  gas.unread_discount_ratio = 0.5;
  const UnreadDiscount discount(gas);
  const double unread_ppm2 = OpenLatticeVariance_ppm2(gas);
  EXPECT_EQ(discount.Of(8.0, 0.0), 8.0);
  EXPECT_NEAR(discount.Of(8.0, unread_ppm2), 8.0 / 1.25, 1e-12);
  EXPECT_NEAR(discount.Of(8.0, 2.0 * unread_ppm2), 4.0, 1e-12);
  EXPECT_NEAR(discount.Of(-8.0, 2.0 * unread_ppm2), -4.0, 1e-12);
  gas.unread_discount_ratio = 0.0;
  EXPECT_EQ(UnreadDiscount(gas).Of(8.0, unread_ppm2), 8.0);
}

TEST(UnreadDiscountTest, IsTheSameInAnyUnit) {
  GasOptions ppm;
  GasOptions ppb = ppm;
  for (double* precision : {&ppb.prior_precision_per_ppm2, &ppb.observation_precision_per_ppm2,
                            &ppb.background_precision_per_ppm2}) {
    *precision *= 1e-6;
  }
  EXPECT_NEAR(UnreadDiscount(ppb).Of(8e3, 0.2e6), 1e3 * UnreadDiscount(ppm).Of(8.0, 0.2), 1e-9);
}

TEST(UnreadDiscountTest, SaysHowFarWhatIsToldMayBeOff) {
  const UnreadDiscount discount((GasOptions()));
  constexpr double kError_ppm = 1e-4;
  constexpr double kRatio = 1e-3;
  for (const double variance_ppm2 : {0.01, 0.2, 0.5, 4.0}) {
    const double told_ppm = discount.Of(50.0, variance_ppm2);
    const double most_ppm = discount.ErrorOf_ppm(told_ppm, kError_ppm, kRatio);
    for (const double off : {1.0 - kRatio, 1.0 + kRatio}) {
      EXPECT_LE(std::abs(discount.Of(50.0 + kError_ppm, off * variance_ppm2) - told_ppm),
                1.01 * most_ppm);
    }
  }
  EXPECT_EQ(UnreadDiscount(PublishedGasOptions()).ErrorOf_ppm(50.0, kError_ppm, kRatio),
            kError_ppm);
}

// Where the background ties each cell as much as its neighbours do, which nobody would want.
TEST(UnreadDiscountTest, HasAUnitWhateverThePrecisions) {
  for (const double ratio : {8.0, 31.0, 32.0, 33.0, 1000.0}) {
    GasOptions gas;
    gas.background_precision_per_ppm2 = ratio * gas.prior_precision_per_ppm2;
    const double alone_ppm2 = 1.0 / gas.background_precision_per_ppm2;
    EXPECT_GT(UnreadDiscount(gas).Of(8.0, alone_ppm2), 4.0) << ratio;
    EXPECT_LT(UnreadDiscount(gas).Of(8.0, alone_ppm2), 8.0) << ratio;
  }
}

TEST(UnreadDiscountTest, IsOfLinearFields) {
  EXPECT_TRUE(UnreadDiscount::Holds(GasOptions{}));
  EXPECT_FALSE(UnreadDiscount::Holds(PublishedGasOptions()));
  GasOptions gas;
  gas.scale = GasScale::kSquareRoot;
  EXPECT_EQ(UnreadDiscount(gas).Of(8.0, 1.0), 8.0);
}

// Towards the background, which is where the field itself tends to.
TEST(UnreadDiscountTest, MapsTellWhatItLeavesOfTheField) {
  const Grid<CellState> states({0.0, 0.0, 0.1, 40, 3}, CellState::kFree);
  GasOptions gas;
  gas.background_mean_ppm = 400.0;
  GasOptions whole = gas;
  whole.unread_discount_ratio = 0.0;
  GasMap map(gas);
  GasMap field(whole);
  for (GasMap* each : {&map, &field}) {
    each->Add(0, {0.15, 0.15}, {900.0});
    ASSERT_TRUE(each->Refresh(states, 0).ok());
  }
  EXPECT_EQ(map.variance_ppm2(), field.variance_ppm2());
  const UnreadDiscount discount(gas);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double expected_ppm =
        400.0 + discount.Of(field.mean_ppm()[i] - 400.0, field.variance_ppm2()[i]);
    EXPECT_NEAR(map.mean_ppm()[i], expected_ppm, 1e-3);
  }
  const auto left = [&](Cell cell) {
    return (map.mean_ppm()[cell] - 400.0) / (field.mean_ppm()[cell] - 400.0);
  };
  EXPECT_GT(left({1, 1}), 0.99) << "where it was read";
  EXPECT_LT(left({20, 1}), 0.8) << "1.9 m away";
}

// In units of the prior, whatever that has become.
TEST(UnreadDiscountTest, FollowsLearnedPrecisions) {
  const Grid<CellState> states({0.0, 0.0, 0.1, 40, 3}, CellState::kFree);
  GasOptions gas;
  gas.precisions = GasPrecisions::kLearned;
  GasOptions whole = gas;
  whole.unread_discount_ratio = 0.0;
  GasMap map(gas);
  GasMap field(whole);
  for (GasMap* each : {&map, &field}) {
    for (int k = 0; k < 40; ++k) each->Add(0, {0.05 + 0.1 * (k % 20), 0.15}, {k % 2 * 50.0});
    ASSERT_TRUE(each->Refresh(states, 0).ok());
    ASSERT_TRUE(each->BeginEpoch(0).ok());
    ASSERT_TRUE(each->Adopt().ok());
  }
  ASSERT_LT(map.quality().prior_precision_scale, 0.5);
  const UnreadDiscount discount(gas);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double told_ppm = discount.Of(field.mean_ppm()[i], field.variance_ppm2()[i]);
    EXPECT_NEAR(map.mean_ppm()[i], told_ppm, 1e-4 * (1.0 + std::abs(told_ppm)));
  }
}

}  // namespace unread_discount_test
}  // namespace plumescout
