// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>

#include "server/missions/mission_registry.h"

namespace plumescout::server {
namespace mission_registry_memory_test {

constexpr std::int64_t kMegabyte = 1'000'000;

TEST(MissionRegistryMemoryTest, BudgetsOfAllMissionsTogetherAreBounded) {
  RegistryOptions options;
  options.memory_budget_bytes = 100 * kMegabyte;
  MissionRegistry registry(options, {});
  MissionOptions mission;
  mission.memory_budget_bytes = 40 * kMegabyte;
  ASSERT_TRUE(registry.Create("a", mission).ok());
  ASSERT_TRUE(registry.Create("b", mission).ok());
  const absl::Status refused = registry.Create("c", mission).status();
  EXPECT_TRUE(absl::IsResourceExhausted(refused));
  EXPECT_THAT(std::string(refused.message()),
              testing::AllOf(testing::StartsWith("LIMIT_REACHED"),
                             testing::HasSubstr("40000000, of 20000000")));
  ASSERT_TRUE(registry.Delete("a").ok());
  ASSERT_TRUE(registry.AwaitStopped(SteadyTime::max()));
  EXPECT_TRUE(registry.Create("c", mission).ok());
}

// 8 KB on the wire, for such a map is deflated well.
TEST(MissionRegistryMemoryTest, AKnownMapBeyondTheMissionsBudgetIsRefused) {
  MissionRegistry registry({}, {});
  MissionOptions mission;
  mission.occupancy.max_extent_m = 400.0;
  mission.occupancy.max_cell_count = 16'000'000;
  mission.prior_map = std::make_shared<const Grid<CellState>>(
      GridGeometry{0.0, 0.0, 0.1, 2900, 2900}, CellState::kFree);
  mission.memory_budget_bytes = 256 * kMegabyte;
  const absl::Status refused = registry.Create("hall", mission).status();
  EXPECT_TRUE(absl::IsResourceExhausted(refused)) << refused;
  EXPECT_THAT(std::string(refused.message()), testing::StartsWith("BUDGET_REACHED: prior_map"));
  EXPECT_TRUE(absl::IsNotFound(registry.Find("hall").status()));
  // The whole field at 0.1 m would take more; so its lattice is coarser.
  mission.gas.field_reach_m = 0.0;
  mission.memory_budget_bytes = 1000 * kMegabyte;
  const auto host = registry.Create("hall", mission);
  ASSERT_TRUE(host.ok()) << host.status();
  EXPECT_GT((*host)->options().gas.lattice_factor, 1);
}

TEST(MissionRegistryMemoryTest, WhatIsHeldBesideMissionsCountsUntilItIsLetGo) {
  RegistryOptions options;
  options.memory_budget_bytes = 100 * kMegabyte;
  MissionRegistry registry(options, {});
  auto room = registry.HoldRoom(70 * kMegabyte);
  ASSERT_TRUE(room.ok()) << room.status();
  EXPECT_EQ(registry.reserved_bytes(), 70 * kMegabyte);
  EXPECT_TRUE(absl::IsResourceExhausted(registry.HoldRoom(40 * kMegabyte).status()));
  room->reset();
  EXPECT_EQ(registry.reserved_bytes(), 0);
  EXPECT_TRUE(registry.HoldRoom(40 * kMegabyte).ok());
}

}  // namespace mission_registry_memory_test
}  // namespace plumescout::server
