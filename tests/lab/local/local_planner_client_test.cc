// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What only this client does; what it shares with others is in tests/client/*_contract_test.cc.
#include "lab/local/local_planner_client.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "client/error_reason.h"
#include "core/types/status_macros.h"
#include "tests/client/ingest_traffic.h"

namespace plumescout::lab {
namespace local_planner_client_test {

using client::GasRange;
using client::kPatience;
using client::LookAround;
using client::RobotSession;

RobotSession Join(LocalPlannerClient& planner, const MissionId& mission) {
  auto session = planner.RegisterRobot(mission, "scout", 0.2, false);
  EXPECT_TRUE(session.ok()) << session.status();
  return session.ok() ? *std::move(session) : RobotSession{};
}

// The plan of a robot that has looked around.
absl::StatusOr<Plan> FirstPlan(std::uint64_t mission_seed) {
  LocalPlannerClient planner;
  MissionOptions options;
  options.seed = mission_seed;
  PLUMESCOUT_RETURN_IF_ERROR(planner.CreateMission("house", options));
  const RobotSession session = Join(planner, "house");
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto stream, planner.OpenObservationStream(session));
  PLUMESCOUT_RETURN_IF_ERROR(client::SendAll(*stream, LookAround(8)).status());
  client::PlanQuery query;
  query.request.robot = "scout";
  query.request.max_edge_evaluations = 1000;
  query.lease_token = session.lease_token;
  query.budget = absl::InfiniteDuration();
  query.timeout = absl::InfiniteDuration();
  return planner.NextBestTrajectory("house", query);
}

TEST(LocalPlannerClientTest, TheSameMissionPlansTheSameToTheLastBit) {
  const absl::StatusOr<Plan> first = FirstPlan(1);
  const absl::StatusOr<Plan> again = FirstPlan(1);
  const absl::StatusOr<Plan> other = FirstPlan(2);

  ASSERT_TRUE(first.ok()) << first.status();
  ASSERT_TRUE(again.ok() && other.ok());
  EXPECT_GE(first->chosen, 0);
  EXPECT_TRUE(*first == *again);
  EXPECT_NE(first->seed, other->seed);
}

TEST(LocalPlannerClientTest, MissionsKnowNothingOfEachOther) {
  LocalPlannerClient planner;
  ASSERT_TRUE(planner.CreateMission("barn", {}).ok());
  ASSERT_TRUE(planner.CreateMission("house", {}).ok());
  const RobotSession in_barn = Join(planner, "barn");
  const RobotSession in_house = Join(planner, "house");
  const auto stream = *planner.OpenObservationStream(in_barn);
  ASSERT_TRUE(client::SendAll(*stream, GasRange(1, 9)).ok());

  EXPECT_EQ((*planner.GetBelief("barn"))->gas_counters.readings, 9);
  EXPECT_EQ((*planner.GetBelief("house"))->gas_counters.readings, 0);
  EXPECT_EQ((*planner.OpenObservationStream(in_house))->opened().applied_sequence, 0);
}

TEST(LocalPlannerClientTest, ABeliefOnceTakenDoesNotChange) {
  LocalPlannerClient planner;
  ASSERT_TRUE(planner.CreateMission("house", {}).ok());
  const auto stream = *planner.OpenObservationStream(Join(planner, "house"));
  const std::shared_ptr<const Belief> before = *planner.GetBelief("house");
  const std::int64_t revision = before->revision;

  ASSERT_TRUE(client::SendAll(*stream, LookAround(8)).ok());

  EXPECT_EQ(before->revision, revision);
  EXPECT_EQ(before->robots.at("scout").state.applied_sequence, 0);
  EXPECT_EQ((*planner.GetBelief("house"))->robots.at("scout").state.applied_sequence, 8);
  EXPECT_TRUE(absl::IsNotFound(planner.GetBelief("barn").status()));
}

TEST(LocalPlannerClientTest, TheMapIsThatOfTheBelief) {
  LocalPlannerClient planner;
  ASSERT_TRUE(planner.CreateMission("house", {}).ok());
  const auto stream = *planner.OpenObservationStream(Join(planner, "house"));
  ASSERT_TRUE(client::SendAll(*stream, LookAround(8)).ok());

  const absl::StatusOr<MapSnapshot> map = planner.GetMap("house");

  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_TRUE(map->occupancy == *(*planner.GetBelief("house"))->occupancy);
  EXPECT_FALSE(map->frontiers.empty());
}

TEST(LocalPlannerClientTest, AFinishedStreamTakesNothingMore) {
  LocalPlannerClient planner;
  ASSERT_TRUE(planner.CreateMission("house", {}).ok());
  const auto stream = *planner.OpenObservationStream(Join(planner, "house"));
  ASSERT_TRUE(stream->Finish().ok());

  EXPECT_TRUE(absl::IsFailedPrecondition(stream->Write(GasRange(1, 1))));
  EXPECT_TRUE(absl::IsFailedPrecondition(stream->Read(kPatience).status()));
  EXPECT_TRUE(absl::IsFailedPrecondition(stream->Finish()));
}

TEST(LocalPlannerClientTest, TheNameOfADeletedMissionIsFreeAndOldStreamsStayDead) {
  LocalPlannerClient planner;
  ASSERT_TRUE(planner.CreateMission("house", {}).ok());
  const auto old_stream = *planner.OpenObservationStream(Join(planner, "house"));
  ASSERT_TRUE(planner.DeleteMission("house").ok());

  ASSERT_TRUE(planner.CreateMission("house", {}).ok());
  const RobotSession session = Join(planner, "house");

  EXPECT_TRUE(absl::IsNotFound(old_stream->Write(GasRange(1, 1))));
  EXPECT_EQ((*planner.OpenObservationStream(session))->opened().applied_sequence, 0);
}

}  // namespace local_planner_client_test
}  // namespace plumescout::lab
