// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/idle_sweeper.h"

#include <gtest/gtest.h>

#include "absl/time/clock.h"
#include "tests/server/host_parts.h"

namespace plumescout::server {
namespace idle_sweeper_test {

TEST(IdleSweeperTest, AMissionThatNobodyUsesIsStoppedAndGone) {
  MissionRegistry registry({}, {});
  std::weak_ptr<MissionHost> brief;
  {
    const auto host = registry.Create("brief", {});
    ASSERT_TRUE(host.ok());
    (*host)->standing().set_idle_time_to_live(absl::Milliseconds(1));
    brief = *host;
  }
  ASSERT_TRUE(registry.Create("hall", {}).ok());
  {
    IdleSweeper sweeper(&registry, absl::Milliseconds(1));
    const absl::Time end = absl::Now() + absl::Seconds(60);
    while (!brief.expired() && absl::Now() < end) absl::SleepFor(absl::Milliseconds(1));
  }
  EXPECT_TRUE(brief.expired());
  EXPECT_TRUE(absl::IsNotFound(registry.Find("brief").status()));
  EXPECT_TRUE(registry.Find("hall").ok());
}

TEST(IdleSweeperTest, ItEndsAtOnceThoughItsPeriodIsLong) {
  MissionRegistry registry({}, {});
  IdleSweeper sweeper(&registry, absl::Hours(1));
}

}  // namespace idle_sweeper_test
}  // namespace plumescout::server
