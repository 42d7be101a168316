// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// A reading store whose precise readings are aged between epochs.
#include <gtest/gtest.h>

#include <vector>

#include "core/gas/reading_store.h"
#include "tests/support/grid_art.h"

namespace plumescout {
namespace reading_store_stale_test {

using ::plumescout::testing::GridFromArt;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kWeek_s = 7 * 24 * 3600;

GasOptions Options(double half_life_s) {
  GasOptions options = PublishedGasOptions();
  options.ageing_half_life_s = half_life_s;
  return options;
}

bool SameBits(const Evidence& a, const Evidence& b) {
  return a.precision == b.precision && a.weighted_deviation == b.weighted_deviation;
}

// 0.1 ppm^2 more in 60 s: 1.7 times the variance of the first reading in a second, a 60th of that
// of the second.
TEST(ReadingStoreStaleTest, AgesStaleCellsAloneAndNeverBack) {
  ReadingStore store(Options(60.0));
  store.Add(0, {0.05, 0.05}, {12.0, 0.001});
  store.Add(0, {0.15, 0.05}, {12.0, 0.1});
  ASSERT_TRUE(store.Place(GridFromArt({".."}), {}).ok());
  EXPECT_EQ(store.TakeChanged().size(), 2U);
  store.AgeStale(3 * kSecond_ns);
  EXPECT_EQ(store.TakeChanged(), std::vector<AnchorCell>{(AnchorCell{0, 0})});
  EXPECT_DOUBLE_EQ(store.EvidenceAt({0, 0}).precision, 1.0 / 0.006);
  EXPECT_DOUBLE_EQ(store.EvidenceAt({1, 0}).precision, 10.0);
  EXPECT_NEAR(store.watch().Error(3 * kSecond_ns), 0.05, 1e-12);

  const std::vector<CellEvidence> epoch = store.EvidenceAsOf(kSecond_ns);
  store.AgeTo(kSecond_ns);  // an epoch that began before
  EXPECT_EQ(store.TakeChanged().size(), 2U);
  EXPECT_DOUBLE_EQ(store.EvidenceAt({0, 0}).precision, 1.0 / 0.006);
  EXPECT_DOUBLE_EQ(store.EvidenceAt({1, 0}).precision, 1.0 / (0.1 + 0.1 / 60.0));
  const std::vector<CellEvidence> all = store.AllEvidence();
  ASSERT_EQ(all.size(), epoch.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_TRUE(SameBits(all[k].evidence, epoch[k].evidence));
    EXPECT_TRUE(SameBits(all[k].evidence, store.EvidenceAt(all[k].cell)));
  }

  store.AgeTo(5 * kSecond_ns);
  EXPECT_DOUBLE_EQ(store.EvidenceAt({0, 0}).precision, 1.0 / (0.001 + 0.1 / 12.0));
}

TEST(ReadingStoreStaleTest, NothingIsStaleWithoutAgeing) {
  ReadingStore store(Options(0.0));
  store.Add(0, {0.05, 0.05}, {12.0, 0.001});
  ASSERT_TRUE(store.Place(GridFromArt({"."}), {}).ok());
  store.TakeChanged();
  store.AgeStale(kWeek_s * kSecond_ns);
  EXPECT_TRUE(store.TakeChanged().empty());
  EXPECT_EQ(store.watch().Error(kWeek_s * kSecond_ns), 0.0);
}

}  // namespace reading_store_stale_test
}  // namespace plumescout
