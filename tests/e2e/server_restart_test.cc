// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The server goes away in the middle of a mission and a new one, which knows nothing, takes its
// place.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <vector>

#include "lab/local/local_planner_client.h"
#include "tests/client/ingest_traffic.h"
#include "tests/e2e/hall_run.h"

namespace plumescout::lab {
namespace server_restart_test {

constexpr std::size_t kPlansBeforeRestart = 3;

// By number; what was sent twice is kept once.
using Log = std::map<std::int64_t, Observation>;

// A mission within one process that is told `log` in one go.
absl::StatusOr<MapSnapshot> Replay(const Log& log) {
  LocalOptions options;
  options.credit_window = static_cast<std::int64_t>(log.size());
  LocalPlannerClient local(options);
  const EpisodeOptions episode = HallOptions();
  EXPECT_TRUE(local.CreateMission(episode.mission, *episode.create).ok());
  const auto session = local.RegisterRobot(episode.mission, episode.robot, 0.2, false);
  EXPECT_TRUE(session.ok()) << session.status();
  const auto stream = *local.OpenObservationStream(*session);
  std::vector<Observation> batch;
  for (const auto& [sequence, observation] : log) batch.push_back(AsOnTheWire(observation));
  EXPECT_TRUE(client::SendAll(*stream, batch).ok());
  return local.GetMap(episode.mission);
}

TEST(ServerRestartTest, TheNewServerIsToldEverythingAndEndsUpWithTheSameMap) {
  auto server = StartServer();
  ASSERT_NE(server, nullptr);
  const int port = server->port();
  const std::string first_boot = server->boot_id();
  const auto grpc = ClientOf(*server);
  Log log;
  const auto planner = WithTap(*grpc, [&log](const Observation& observation) {
    log.emplace(observation.sequence, observation);
    return observation;
  });
  EpisodeOptions options = HallOptions();
  std::size_t plans = 0;
  options.on_plan = [&](const IssuedPlan&) {
    if (++plans != kPlansBeforeRestart) return;
    server.reset();
    server = StartServer(port);
  };

  const absl::StatusOr<HallRun> run = RunInHall(*planner, options);

  ASSERT_TRUE(run.ok()) << run.status();
  EXPECT_NE(server->boot_id(), first_boot);
  EXPECT_GT(plans, kPlansBeforeRestart);
  EXPECT_EQ(run->episode.readings_applied, run->episode.readings_sent);
  ASSERT_EQ(run->map.robots.size(), 1U);
  EXPECT_EQ(run->map.robots[0].applied_sequence, run->episode.readings_sent);
  EXPECT_EQ(run->map.robots[0].rejected_observations, 0);
  ASSERT_EQ(static_cast<std::int64_t>(log.size()), run->episode.readings_sent);
  const absl::StatusOr<MapSnapshot> undisturbed = Replay(log);
  ASSERT_TRUE(undisturbed.ok()) << undisturbed.status();
  EXPECT_TRUE(SameMap(run->map, *undisturbed));
}

}  // namespace server_restart_test
}  // namespace plumescout::lab
