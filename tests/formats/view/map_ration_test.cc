// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/view/map_ration.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumescout {
namespace map_ration_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(MapRationTest, TheFirstOfEachLayerIsShown) {
  MapRation ration(0.1);
  EXPECT_TRUE(ration.Allows("a", 1000, 0));
  EXPECT_TRUE(ration.Allows("b", 1000, 0));
  EXPECT_FALSE(ration.Allows("a", 1, 1));
}

TEST(MapRationTest, AllTogetherKeepToTheShare) {
  MapRation ration(0.1);
  double shown = 0.0;
  double journal = 0.0;
  for (int i = 0; i < 1000; ++i) {
    ration.NoteRecord(500);
    journal += 500.0;
    for (const char* layer : {"a", "b"}) {
      if (ration.Allows(layer, 300, i * kSecond_ns / 10)) shown += 300.0;
    }
  }
  EXPECT_LE(shown, 0.1 * journal);
  EXPECT_GT(shown, 0.08 * journal) << "and use it";
}

TEST(MapRationTest, NoLayerIsKeptFromBeingShownForEver) {
  MapRation ration(0.0);
  ASSERT_TRUE(ration.Allows("a", 100, 0));
  EXPECT_FALSE(ration.Allows("a", 100, MapRation::kLongest_ns - 1));
  EXPECT_TRUE(ration.Allows("a", 100, MapRation::kLongest_ns));
  EXPECT_FALSE(ration.Allows("a", 100, 2 * MapRation::kLongest_ns - 1));
}

TEST(MapRationTest, AnInfiniteShareShowsAll) {
  MapRation ration(std::numeric_limits<double>::infinity());
  ration.NoteRecord(1);
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(ration.Allows("a", 1'000'000, i));
}

}  // namespace map_ration_test
}  // namespace plumescout
