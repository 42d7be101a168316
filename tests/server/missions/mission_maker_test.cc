// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_maker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "core/types/error_reason.h"
#include "server/missions/mission_recovery.h"
#include "tests/server/held_store.h"
#include "tests/server/host_parts.h"

namespace plumescout::server {
namespace mission_maker_test {

TEST(MissionMakerTest, ANewMissionIsInTheStore) {
  HeldStore store;
  RegistryOptions options;
  options.host.wall_clock = [] { return std::int64_t{99}; };
  RegistryHooks hooks;
  hooks.store = &store;
  const MissionMaker maker(options, hooks);
  MissionOptions mission;
  mission.seed = 5;
  const auto host = maker.Make("hall", mission, {"ann", "acme"});
  ASSERT_TRUE(host.ok()) << host.status();
  const auto stored = store.Peek("acme/hall");
  ASSERT_TRUE(stored.ok()) << stored.status();
  const auto start = DecodeStart(stored->header);
  ASSERT_TRUE(start.ok()) << start.status();
  EXPECT_EQ(start->mission, "hall");
  EXPECT_EQ(start->owner, "ann");
  EXPECT_EQ(start->tenant, "acme");
  EXPECT_EQ(start->created_ns, 99);
  EXPECT_EQ(OptionsOf(*start)->seed, 5U);
  EXPECT_EQ(ErrorReason(maker.Make("hall", mission, {"bob", "acme"}).status()),
            reason::kMissionExists);
}

TEST(MissionMakerTest, LeasesOfEachLifeAreGreaterThanThoseOfTheLifeBefore) {
  HeldStore store;
  RegistryHooks hooks;
  hooks.store = &store;
  const MissionMaker maker({}, hooks);
  const auto first = maker.Make("hall", {}, {}).value();
  const std::int64_t token = *first->leases().Propose("r1", false);
  first->Stop(absl::UnavailableError("over"));
  const auto second = maker.Revive("hall", NeverStop());
  ASSERT_TRUE(second.ok()) << second.status();
  EXPECT_GT(*(*second)->leases().Propose("r1", false), token);
  EXPECT_TRUE(absl::IsNotFound(maker.Revive("attic", NeverStop()).status()));
}

TEST(MissionMakerTest, MissionsLiveByTheClocksThatTheyAreGiven) {
  SteadyTime steady;
  RegistryHooks hooks;
  hooks.clock = [&] { return steady; };
  hooks.wall_clock = [] { return std::int64_t{1000}; };
  const MissionMaker maker({}, hooks);
  const auto host = maker.Make("hall", {}, {}).value();
  steady += std::chrono::nanoseconds(7);
  EXPECT_EQ(host->clock().now_ns(), 1007);
}

TEST(MissionMakerTest, WithoutAStoreLeasesBeginWhereTheServerSays) {
  RegistryOptions options;
  options.host.first_lease_token = 1234;
  const MissionMaker maker(options, {});
  EXPECT_EQ(*maker.Make("hall", {}, {}).value()->leases().Propose("r1", false), 1234);
}

TEST(MissionMakerTest, ChoicesBeyondTheServersAreRefused) {
  RegistryOptions options;
  options.max_beam_count = 100;
  const MissionMaker maker(options, {});
  MissionOptions mission;
  mission.max_beam_count = 101;
  EXPECT_TRUE(absl::IsInvalidArgument(maker.CheckChoices(mission)));
  mission.max_beam_count = 100;
  EXPECT_TRUE(maker.CheckChoices(mission).ok());
}

TEST(MissionMakerTest, KeysOfTenantsDiffer) {
  EXPECT_EQ(MissionKey("", "hall"), "hall");
  EXPECT_EQ(MissionKey("acme", "hall"), "acme/hall");
}

}  // namespace mission_maker_test
}  // namespace plumescout::server
