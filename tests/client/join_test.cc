// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/join.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/client/fake_planner_client.h"

namespace plumescout::client {
namespace join_test {

using ::testing::ElementsAre;

TEST(JoinTest, AMissionThatIsNotThereIsNotFoundUnlessItIsToBeCreated) {
  FakePlannerClient server;

  EXPECT_TRUE(absl::IsNotFound(Join(server, {.mission = "m", .robot = "r"}).status()));

  const auto session = Join(server, {.mission = "m", .robot = "r", .create = MissionOptions{}});
  ASSERT_TRUE(session.ok()) << session.status();
  EXPECT_EQ(session->mission, "m");
  EXPECT_EQ(session->robot, "r");
}

TEST(JoinTest, AMissionThatIsThereIsJoined) {
  FakePlannerClient server;
  server.Preload(12);

  const auto session = Join(server, {.mission = "m", .robot = "r", .create = MissionOptions{}});

  ASSERT_TRUE(session.ok()) << session.status();
  EXPECT_EQ(session->ingest.applied_sequence, 12);
}

TEST(JoinTest, TheRobotRegistersAsItIs) {
  FakePlannerClient server;
  server.Preload(0);

  ASSERT_TRUE(Join(server, {.mission = "m",
                            .robot = "r",
                            .radius_m = 0.35,
                            .take_over = true,
                            .log_epoch = 77,
                            .frame = {{1.0, 2.0, 0.5}, 0.1, 0.02},
                            .sensors = {{"pid", {0.1, 0.0}, 0.5, 2.0}}})
                  .ok());

  const RobotOutfit outfit = {{{1.0, 2.0, 0.5}, 0.1, 0.02}, {{"pid", {0.1, 0.0}, 0.5, 2.0}}};
  EXPECT_THAT(server.registrations(),
              ElementsAre(FakePlannerClient::Registration{"m", "r", 0.35, true, 77, outfit}));
}

TEST(JoinTest, ABrokenLinkIsReportedAndNobodyRegisters) {
  FakePlannerClient server;
  server.BreakLink();

  EXPECT_TRUE(absl::IsUnavailable(
      Join(server, {.mission = "m", .robot = "r", .create = MissionOptions{}}).status()));

  server.MendLink();
  EXPECT_TRUE(server.registrations().empty());
}

}  // namespace join_test
}  // namespace plumescout::client
