// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/mission_message.h"

#include <gtest/gtest.h>

#include <memory>

#include "core/types/error_reason.h"
#include "tests/server/host_parts.h"

namespace plumescout::server {
namespace mission_message_test {

TEST(MissionMessageTest, TellsWhatAMissionIs) {
  MissionHost host(HostParts(), HostOptions{});
  const v1::Mission mission = DescribeMission(host, host.options());
  EXPECT_EQ(mission.name(), "missions/hall");
  EXPECT_EQ(mission.owner(), "anonymous");
  EXPECT_EQ(mission.state(), v1::MISSION_STATE_RUNNING);
  EXPECT_EQ(mission.memory().budget_bytes(), host.options().memory_budget_bytes);
  EXPECT_FALSE(mission.has_idle_time_to_live());
}

TEST(MissionMessageTest, MissionsThatDoNotRunSayWhy) {
  const auto typed = [](absl::string_view reason) {
    return TypedError(absl::StatusCode::kUnavailable, reason, "why");
  };
  EXPECT_EQ(DescribeMission(AbsentMission{"acme/hall", typed(reason::kRecovering)}).state(),
            v1::MISSION_STATE_RECOVERING);
  EXPECT_EQ(DescribeMission(AbsentMission{"acme/hall", typed(reason::kRecovering), true}).state(),
            v1::MISSION_STATE_SLEEPING);
  const v1::Mission damaged = DescribeMission(AbsentMission{"hall", typed(reason::kStoreDamaged)});
  EXPECT_EQ(damaged.state(), v1::MISSION_STATE_DAMAGED);
  EXPECT_EQ(damaged.name(), "missions/hall");
  const v1::Mission elsewhere = DescribeMission(OwnedMission{"acme/hall", "n2"});
  EXPECT_EQ(elsewhere.name(), "missions/hall");
  EXPECT_EQ(elsewhere.state(), v1::MISSION_STATE_ELSEWHERE);
  EXPECT_EQ(elsewhere.node(), "n2");
  EXPECT_EQ(DescribeMission(OwnedMission{"hall", ""}).state(), v1::MISSION_STATE_SLEEPING);
}

TEST(MissionMessageTest, KnownMapCanBeLeftOut) {
  MissionOptions options;
  options.prior_map = std::make_shared<const Grid<CellState>>();
  EXPECT_EQ(WithoutPriorMap(options).prior_map, nullptr);
}

}  // namespace mission_message_test
}  // namespace plumescout::server
