// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Gas maps that run out of room, or are no longer wanted.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <vector>

#include "core/gas/field_audit.h"
#include "core/gas/gas_map.h"
#include "tests/core/gas/dense_field.h"

namespace plumescout {
namespace gas_map_limits_test {

Grid<CellState> Open(int width, int height) {
  return Grid<CellState>(GridGeometry{0.0, 0.0, 0.1, width, height}, CellState::kFree);
}

std::int64_t Bytes(const GasMap& map) { return map.field_bytes(); }

TEST(GasMapLimitsTest, AFieldBeyondItsLimitGetsACoarserLattice) {
  GasMap map{GasOptions()};
  map.Add(0, {1.05, 1.05}, {10.0});
  ASSERT_TRUE(map.Refresh(Open(40, 40), 0).ok());
  EXPECT_EQ(map.lattice_factor(), 1);
  const std::int64_t full_bytes = Bytes(map);
  map.LimitField(full_bytes - 1);
  ASSERT_TRUE(map.Refresh(Open(41, 40), 0).ok());
  EXPECT_EQ(map.lattice_factor(), 2);
  EXPECT_LE(Bytes(map), full_bytes - 1);
  for (const float variance_ppm2 : map.variance_ppm2().values()) EXPECT_GT(variance_ppm2, 0.0F);
}

// What is made coarse later is the map that was coarse from the beginning.
TEST(GasMapLimitsTest, ACoarserFieldIsTheFieldOfThatFactor) {
  Rng rng(5);
  GasOptions coarse_options;
  coarse_options.lattice_factor = 4;
  GasMap coarse(coarse_options);
  GasMap map{GasOptions()};
  Grid<CellState> states = testing::RandomStates(60, 52, 0.2, rng);
  for (int k = 0; k < 30; ++k) {
    const Point2 place =
        states.geometry().Center(states.geometry().CellAtIndex(rng.Below(states.size())));
    const GasReading reading{rng.Uniform(0.0, 30.0)};
    map.Add(k, place, reading);
    coarse.Add(k, place, reading);
  }
  ASSERT_TRUE(map.Refresh(states, 30).ok());
  states[Cell{3, 3}] = CellState::kFree;
  states[Cell{4, 3}] = CellState::kOccupied;
  ASSERT_TRUE(coarse.Refresh(states, 30).ok());
  map.LimitField(coarse.field_bytes());
  ASSERT_TRUE(map.Refresh(states, 30).ok());
  ASSERT_EQ(map.lattice_factor(), 4);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] != CellState::kFree) continue;
    EXPECT_FLOAT_EQ(map.mean_ppm()[i], coarse.mean_ppm()[i]);
    EXPECT_FLOAT_EQ(map.variance_ppm2()[i], coarse.variance_ppm2()[i]);
  }
  const auto audit = map.MakeAudit();
  ASSERT_NE(audit, nullptr);
  const auto finding = RunAudit(*audit);
  ASSERT_TRUE(finding.ok()) << finding.status();
  EXPECT_TRUE(finding->certified);
  ASSERT_NE(map.what_if(), nullptr);
  EXPECT_TRUE(map.what_if()->VarianceIfRead(std::vector<Cell>{{3, 3}}, 10.0).ok());
  ASSERT_TRUE(map.BeginEpoch(31).ok());
  ASSERT_TRUE(map.Adopt().ok());
  EXPECT_EQ(map.lattice_factor(), 4);
}

TEST(GasMapLimitsTest, NoLatticeIsCoarserThanOptionsAllow) {
  GasMap map{GasOptions()};
  map.LimitField(0);
  ASSERT_TRUE(map.Refresh(Open(40, 40), 0).ok());
  EXPECT_EQ(map.lattice_factor(), kMostLatticeFactor);
  ASSERT_TRUE(map.Refresh(Open(44, 40), 0).ok());
  EXPECT_EQ(map.lattice_factor(), kMostLatticeFactor);
}

TEST(GasMapLimitsTest, AnAbandonedMapEndsWithCancelled) {
  bool stop = false;
  GasMap map{GasOptions()};
  map.AbandonWhen([&] { return stop; });
  ASSERT_TRUE(map.Refresh(Open(40, 40), 0).ok());
  ASSERT_TRUE(map.BeginEpoch(0).ok());
  stop = true;
  EXPECT_TRUE(absl::IsCancelled(map.Adopt()));
  EXPECT_TRUE(absl::IsCancelled(map.Refresh(Open(41, 40), 0)));
}

double Cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// How long the map computes without asking, as a share of the whole: seconds belong to the machine.
TEST(GasMapLimitsTest, ALargeRefreshAsksOften) {
  constexpr double kLongestShare = 0.15;
  GasMap map{GasOptions()};
  const double begun_s = Cpu_s();
  double asked_s = begun_s;
  double longest_s = 0.0;
  std::int64_t times = 0;
  map.AbandonWhen([&] {
    longest_s = std::max(longest_s, Cpu_s() - asked_s);
    asked_s = Cpu_s();
    ++times;
    return false;
  });
  ASSERT_TRUE(map.Refresh(Open(400, 400), 0).ok());
  longest_s = std::max(longest_s, Cpu_s() - asked_s);
  const double whole_s = Cpu_s() - begun_s;
  EXPECT_LT(longest_s, kLongestShare * whole_s);
  const std::int64_t in_all = times;
  for (const double share : {0.0, 0.1, 0.4, 0.9}) {  // in the dissection, up the tree and down
    GasMap abandoned{GasOptions()};
    times = 0;
    abandoned.AbandonWhen([&] {
      asked_s = Cpu_s();
      return static_cast<double>(++times) > share * static_cast<double>(in_all);
    });
    EXPECT_TRUE(absl::IsCancelled(abandoned.Refresh(Open(400, 400), 0))) << share;
    EXPECT_LT(Cpu_s() - asked_s, kLongestShare * whole_s) << share;
    EXPECT_LT(times, in_all) << share;
  }
}

}  // namespace gas_map_limits_test
}  // namespace plumescout
