// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_maps.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "core/gas/field_bytes.h"
#include "core/gas/gas_state.h"
#include "core/types/byte_archive.h"
#include "core/types/byte_reader.h"
#include "core/types/species.h"
#include "tests/core/gas/gas_map_peer.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace gas_maps_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

MissionOptions Three() {
  MissionOptions options;
  for (const char* name : {"methane", "ozone", "ammonia"}) {
    options.gas_species.emplace_back().name = name;
  }
  options.gas_species[1].background_mean_ppm = 2.0;
  return options;
}

Grid<CellState> Hall(int width) {
  return Grid<CellState>({0.0, 0.0, 0.1, width, 20}, CellState::kFree);
}

// What happens at one moment to one of the fields or to all of them.
void ReadAndRefresh(std::int64_t at, auto& map, auto& read) {
  read.Add(at * kSecond_ns, {0.55 + 0.1 * static_cast<double>(at % 9), 1.05},
           {static_cast<double>(at), 0.0});
  EXPECT_TRUE(map.Refresh(Hall(20 + static_cast<int>(at)), at * kSecond_ns).ok());
}

TEST(GasMapsTest, EachIsWhatItWouldBeAlone) {
  const MissionOptions options = Three();
  GasMaps together(options);
  ASSERT_EQ(together.count(), 3u);
  GasMap alone(GasOptionsOf(options, 1), options.occupancy.resolution_m);
  for (std::int64_t at = 1; at <= 30; ++at) {
    together[0].Add(at * kSecond_ns, {1.05, 1.55}, {50.0, 0.0});
    ReadAndRefresh(at, together, together[1]);
    ReadAndRefresh(at, alone, alone);
    if (at == 10) {
      EXPECT_TRUE(together.BeginEpoch(at * kSecond_ns).ok());
      EXPECT_TRUE(alone.BeginEpoch(at * kSecond_ns).ok());
    }
    if (at == 15) {
      EXPECT_TRUE(together.Adopt().ok());
      EXPECT_TRUE(alone.Adopt().ok());
    }
  }
  EXPECT_TRUE(support::SameBytes(together[1].mean_ppm(), alone.mean_ppm()));
  EXPECT_TRUE(support::SameBytes(together[1].variance_ppm2(), alone.variance_ppm2()));
  EXPECT_EQ(together[1].quality(), alone.quality());
  EXPECT_EQ(together[1].counters(), alone.counters());
  EXPECT_EQ(together[2].counters(), GasCounters());
  const Cell read{10, 15};
  EXPECT_GT(together.first().mean_ppm()[read], 10.0F);
}

TEST(GasMapsTest, EpochsBeginAndEndTogether) {
  GasMaps maps(Three());
  EXPECT_FALSE(maps.epoch_possible());
  EXPECT_TRUE(absl::IsFailedPrecondition(maps.BeginEpoch(0)));
  EXPECT_TRUE(absl::IsFailedPrecondition(maps.Adopt()));
  ASSERT_TRUE(maps.Refresh(Hall(20), kSecond_ns).ok());
  ASSERT_TRUE(maps.epoch_possible());
  EXPECT_EQ(maps.epoch(), nullptr);
  ASSERT_TRUE(maps.BeginEpoch(kSecond_ns).ok());
  EXPECT_FALSE(maps.epoch_possible());
  EXPECT_FALSE(maps.can_be_written());
  EXPECT_TRUE(absl::IsFailedPrecondition(maps.BeginEpoch(kSecond_ns)));
  const auto epoch = maps.epoch();
  ASSERT_NE(epoch, nullptr);
  EXPECT_FALSE(epoch->done());
  epoch->Recompute();
  EXPECT_TRUE(epoch->done());
  for (std::size_t i = 0; i < maps.count(); ++i) EXPECT_TRUE(maps[i].epoch()->done());
  EXPECT_FALSE(maps.adoption_due(kSecond_ns));
  EXPECT_TRUE(maps.adoption_due(2 * kSecond_ns));
  ASSERT_TRUE(maps.Adopt().ok());
  EXPECT_EQ(maps.epoch(), nullptr);
  EXPECT_TRUE(maps.can_be_written());
  for (std::size_t i = 0; i < maps.count(); ++i) EXPECT_EQ(maps[i].quality().epochs, 1);
  EXPECT_TRUE(maps.audit_due());
}

TEST(GasMapsTest, OneThatIsStaleMakesAllSo) {
  GasMaps maps(Three());
  ASSERT_TRUE(maps.Refresh(Hall(20), kSecond_ns).ok());
  EXPECT_FALSE(maps.stale());
  EXPECT_FALSE(maps.replaced());
  maps[2].Add(kSecond_ns, {1.05, 1.05}, {1.0, 0.0});
  EXPECT_TRUE(maps.stale());
  ASSERT_TRUE(maps.Refresh(Hall(20), 2 * kSecond_ns).ok());
  EXPECT_FALSE(maps.stale());
  EXPECT_EQ(maps.reading_sites(), 1);
}

// Though one of them fails, the others are refreshed.
TEST(GasMapsTest, AFieldThatFailsLeavesTheOthers) {
  if (GasMapPeer::kStopsAtDefects) return;
  GasMaps maps(Three());
  ASSERT_TRUE(maps.Refresh(Hall(20), kSecond_ns).ok());
  GasMapPeer::LosePrior(maps[0]);
  for (std::size_t i = 0; i < 2; ++i) maps[i].Add(kSecond_ns, {1.05, 1.05}, {9.0, 0.0});
  const absl::Status failed = maps.Refresh(Hall(20 + 400), 2 * kSecond_ns);
  EXPECT_EQ(failed.code(), absl::StatusCode::kInternal);
  EXPECT_EQ(maps[0].quality().failures, 1);
  EXPECT_EQ(maps[1].quality().failures, 0);
  EXPECT_EQ(maps[1].counters().in_posterior, 1);
  EXPECT_TRUE(maps.epoch_possible()) << "of the others";
  ASSERT_TRUE(maps.BeginEpoch(2 * kSecond_ns).ok());
  EXPECT_EQ(maps[0].epoch(), nullptr);
  EXPECT_TRUE(maps.Adopt().ok());
  EXPECT_TRUE(maps.can_be_written());
}

TEST(GasMapsTest, AFurtherFieldThatFailsIsCountedAndKeepsNobodyFromTheFirst) {
  if (GasMapPeer::kStopsAtDefects) return;
  GasMaps maps(Three());
  ASSERT_TRUE(maps.Refresh(Hall(20), kSecond_ns).ok());
  GasMapPeer::LosePrior(maps[1]);
  for (std::size_t i = 0; i < 2; ++i) maps[i].Add(kSecond_ns, {1.05, 1.05}, {9.0, 0.0});
  EXPECT_TRUE(maps.Refresh(Hall(20 + 400), 2 * kSecond_ns).ok());
  EXPECT_EQ(maps[0].quality().failures, 0);
  EXPECT_EQ(maps[0].counters().in_posterior, 1);
  EXPECT_EQ(maps[1].quality().failures, 1);
}

TEST(GasMapsTest, TheyShareWhatFieldsMayTake) {
  GasMaps maps(Three());
  GasMap alone(GasOptions(), 0.1);
  const std::int64_t limit_bytes = FieldBytes(2000, 10'000);
  maps.LimitFields(3 * limit_bytes);
  alone.LimitField(limit_bytes);
  ASSERT_TRUE(maps.Refresh(Hall(300), kSecond_ns).ok());
  ASSERT_TRUE(alone.Refresh(Hall(300), kSecond_ns).ok());
  EXPECT_GT(maps.lattice_factor(), 1);
  for (std::size_t i = 0; i < maps.count(); ++i) {
    EXPECT_EQ(maps[i].lattice_factor(), alone.lattice_factor());
  }
  EXPECT_EQ(maps.field_bytes(), 3 * alone.field_bytes());
}

TEST(GasMapsTest, OneGasIsWrittenAsAGasMap) {
  GasMaps maps{MissionOptions()};
  GasMap alone(GasOptions(), MissionOptions().occupancy.resolution_m);
  ReadAndRefresh(1, maps, maps[0]);
  ReadAndRefresh(1, alone, alone);
  ByteWriter of_maps;
  of_maps(maps);
  ByteWriter of_one;
  of_one(alone);
  EXPECT_EQ(of_maps.sink().bytes, of_one.sink().bytes);
}

TEST(GasMapsTest, WhatIsWrittenIsMadeAgain) {
  GasMaps maps(Three());
  for (std::int64_t at = 1; at <= 3; ++at) ReadAndRefresh(at, maps, maps[1]);
  ASSERT_TRUE(maps.BeginEpoch(4 * kSecond_ns).ok());
  ASSERT_TRUE(maps.Adopt().ok());
  ASSERT_TRUE(maps.can_be_written());
  ByteWriter writer;
  writer(maps);
  GasMaps again(Three());
  ByteReader reader(writer.sink().bytes, std::size_t{1} << 30);
  reader(again);
  ASSERT_TRUE(reader.Finish().ok()) << reader.Finish();
  ASSERT_TRUE(again.MakeFieldsAgain().ok());
  for (std::size_t i = 0; i < maps.count(); ++i) {
    EXPECT_TRUE(support::SameBytes(again[i].mean_ppm(), maps[i].mean_ppm()));
    EXPECT_TRUE(support::SameBytes(again[i].variance_ppm2(), maps[i].variance_ppm2()));
    EXPECT_EQ(again[i].counters(), maps[i].counters());
  }
}

}  // namespace gas_maps_test
}  // namespace plumescout
