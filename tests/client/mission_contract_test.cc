// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Missions, their robots and their maps.
#include "tests/client/planner_client_contract.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "client/error_reason.h"

namespace plumescout::client {
namespace mission_contract_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

class MissionContract : public PlannerClientContract {};

TEST_P(MissionContract, MissionsAreCreatedListedAndDeleted) {
  EXPECT_TRUE(absl::IsAlreadyExists(client().CreateMission("house", {})));
  EXPECT_TRUE(client().CreateMission("barn", {}).ok());
  EXPECT_THAT(*client().ListMissions(), ElementsAre("barn", "house"));

  EXPECT_TRUE(client().DeleteMission("house").ok());

  EXPECT_THAT(*client().ListMissions(), ElementsAre("barn"));
  EXPECT_TRUE(absl::IsNotFound(client().DeleteMission("house")));
  EXPECT_TRUE(absl::IsNotFound(client().GetMap("house").status()));
}

TEST_P(MissionContract, BadNamesAndOptionsAreRefused) {
  EXPECT_TRUE(absl::IsInvalidArgument(client().CreateMission("House!", {})));
  EXPECT_TRUE(absl::IsInvalidArgument(client().CreateMission("", {})));
  MissionOptions options;
  options.gas.prior_precision_per_ppm2 = std::nan("");
  EXPECT_TRUE(absl::IsInvalidArgument(client().CreateMission("barn", options)));
  EXPECT_TRUE(absl::IsInvalidArgument(
      client().RegisterRobot("house", "Bad Robot", kRadius_m, false).status()));
  EXPECT_TRUE(
      absl::IsInvalidArgument(client().RegisterRobot("house", "scout", -1.0, false).status()));
}

TEST_P(MissionContract, RobotsOfUnknownMissionsAreNotFound) {
  EXPECT_TRUE(
      absl::IsNotFound(client().RegisterRobot("nowhere", "scout", kRadius_m, false).status()));
}

TEST_P(MissionContract, AFreshRobotStartsWithAnEmptyLogAndSomeCredit) {
  const RobotSession session = Register();

  EXPECT_EQ(session.mission, "house");
  EXPECT_EQ(session.robot, "scout");
  EXPECT_THAT(session.server_boot_id, Not(IsEmpty()));
  EXPECT_EQ(session.ingest.applied_sequence, 0);
  const auto stream = Open(session);
  ASSERT_NE(stream, nullptr);
  EXPECT_EQ(stream->opened().applied_sequence, 0);
  EXPECT_GT(stream->opened().credit_sequence, 0);
}

// Its frame lies at (10, 5) of the mission, turned by a quarter.
TEST_P(MissionContract, ARobotSendsInItsOwnFrameAndCorrectsWhatItSent) {
  const RobotFrame frame{{10.0, 5.0, M_PI / 2}, 0.1, 0.01};
  const auto session = client().RegisterRobot("house", "scout", kRadius_m, false, 0, {frame, {}});
  ASSERT_TRUE(session.ok()) << session.status();
  const auto stream = Open(*session);
  std::vector<Observation> batch;
  for (std::int64_t sequence = 1; sequence <= 5; ++sequence) batch.push_back(GasAt(sequence, 2.0));
  Observation correction = GasAt(6, 3.0);
  correction.payload = PoseCorrection{{{batch[0].sample_time_ns, {3.0, 0.0, 0.0}}}};
  batch.push_back(correction);
  Observation never_seen = GasAt(7, 3.0);
  never_seen.payload = PoseCorrection{{{1, {3.0, 0.0, 0.0}}}};
  batch.push_back(never_seen);

  const auto sent = SendAll(*stream, batch);

  ASSERT_TRUE(sent.ok()) << sent.status();
  ASSERT_EQ(sent->refused.size(), 1U);
  EXPECT_EQ(sent->refused[0].sequence, 7);
  EXPECT_TRUE(absl::IsInvalidArgument(sent->refused[0].status)) << sent->refused[0].status;
  const auto map = client().GetMap("house");
  ASSERT_TRUE(map.ok()) << map.status();
  ASSERT_EQ(map->robots.size(), 1U);
  EXPECT_NEAR(map->robots[0].pose.x_m, 10.0, 1e-9);
  EXPECT_NEAR(map->robots[0].pose.y_m, 8.0, 1e-9);
  EXPECT_FALSE(map->robots[0].frame_suspect);
  EXPECT_EQ(map->gas_counters.readings, 5);
  RobotFrame tilted = frame;
  tilted.mission_from_robot.x_m = std::nan("");
  EXPECT_TRUE(absl::IsInvalidArgument(
      client().RegisterRobot("house", "second", kRadius_m, false, 0, {tilted, {}}).status()));
}

TEST_P(MissionContract, ReadingsAreOfTheGasOfTheirSensor) {
  MissionOptions options;
  options.gas_species.emplace_back().name = "methane";
  options.gas_species.emplace_back().name = "ozone";
  ASSERT_TRUE(client().CreateMission("plant", options).ok());
  std::vector<GasSensor> sensors = {{"pid", {}, 0.0, 0.0}, {"ox", {}, 0.0, 0.0, "ozone"}};
  const auto session = client().RegisterRobot("plant", "scout", kRadius_m, false, 0, {{}, sensors});
  ASSERT_TRUE(session.ok()) << session.status();
  std::vector<Observation> batch;
  for (std::int64_t sequence = 1; sequence <= 5; ++sequence) batch.push_back(GasAt(sequence, 2.0));
  std::get<GasReading>(batch[4].payload).sensor = 1;
  ASSERT_TRUE(SendAll(*Open(*session), batch).ok());
  const auto map = client().GetMap("plant");
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->gas_counters.readings, 4);
  ASSERT_EQ(map->gases.size(), 2U);
  EXPECT_EQ(map->gases[0].counters.readings, 4);
  EXPECT_EQ(map->gases[1].species, "ozone");
  EXPECT_EQ(map->gases[1].counters.readings, 1);
  sensors[1].species = "xenon";
  EXPECT_TRUE(absl::IsInvalidArgument(
      client().RegisterRobot("plant", "other", kRadius_m, false, 0, {{}, sensors}).status()));
}

TEST_P(MissionContract, ARobotHearsWhetherItsLogGoesOn) {
  const auto join = [this](std::int64_t log_epoch) {
    auto session = client().RegisterRobot("house", "scout", kRadius_m, true, log_epoch);
    EXPECT_TRUE(session.ok()) << session.status();
    return session.ok() ? *session : RobotSession{};
  };
  const RobotSession first = join(8);
  EXPECT_TRUE(first.log_continues);
  ASSERT_TRUE(SendAll(*Open(first), GasRange(1, 3)).ok());

  EXPECT_TRUE(join(8).log_continues);
  EXPECT_TRUE(join(0).log_continues);
  const RobotSession other = join(9);
  EXPECT_FALSE(other.log_continues);
  EXPECT_EQ(other.ingest.applied_sequence, 3);
  EXPECT_TRUE(absl::IsInvalidArgument(
      client().RegisterRobot("house", "scout", kRadius_m, true, -1).status()));
}

TEST_P(MissionContract, AStreamSaysWhichServerAnswers) {
  const RobotSession session = Register();
  EXPECT_EQ(Open(session)->server_boot_id(), session.server_boot_id);
}

TEST_P(MissionContract, ALeaseInUseIsNotGivenAwayUnlessTakenOver) {
  const RobotSession first = Register();
  const auto stream = Open(first);

  EXPECT_EQ(ErrorReason(client().RegisterRobot("house", "scout", kRadius_m, false).status()),
            kLeaseHeld);

  const auto second = client().RegisterRobot("house", "scout", kRadius_m, true);
  ASSERT_TRUE(second.ok()) << second.status();
  EXPECT_NE(second->lease_token, first.lease_token);
  EXPECT_EQ(ErrorReason(ReadUntilError(*stream)), kLeaseSuperseded);
}

TEST_P(MissionContract, AnOldLeaseIsFencedOffEverywhere) {
  const RobotSession first = Register();
  const auto second = client().RegisterRobot("house", "scout", kRadius_m, true);
  ASSERT_TRUE(second.ok());

  EXPECT_EQ(ErrorReason(client().OpenObservationStream(first).status()), kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(client().NextBestTrajectory("house", Query(first)).status()),
            kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(client().ReportProgress(first, 1, ProgressOutcome::kReached)),
            kLeaseSuperseded);
  EXPECT_NE(Open(*second), nullptr);
}

TEST_P(MissionContract, ARobotThatLeavesIsForgottenButForItsLog) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(SendAll(*stream, LookAround(3)).ok());

  ASSERT_TRUE(client().RemoveRobot("house", "scout", session.lease_token, false).ok());

  EXPECT_TRUE(absl::IsNotFound(ReadUntilError(*stream)));
  EXPECT_TRUE(absl::IsNotFound(client().OpenObservationStream(session).status()));
  EXPECT_TRUE(absl::IsNotFound(client().RemoveRobot("house", "scout", session.lease_token, true)));
  EXPECT_TRUE(client().GetMap("house")->robots.empty());
  const RobotSession back = Register();
  EXPECT_EQ(back.ingest.applied_sequence, 3);
  EXPECT_NE(back.lease_token, session.lease_token);
}

TEST_P(MissionContract, OnlyForceRemovesARobotWithoutItsLease) {
  const RobotSession session = Register();

  EXPECT_EQ(ErrorReason(client().RemoveRobot("house", "scout", session.lease_token + 1, false)),
            kLeaseSuperseded);
  EXPECT_NE(Open(session), nullptr);

  EXPECT_TRUE(client().RemoveRobot("house", "scout", 0, true).ok());
  EXPECT_TRUE(absl::IsNotFound(client().OpenObservationStream(session).status()));
  EXPECT_TRUE(absl::IsNotFound(client().RemoveRobot("house", "other", 0, true)));
  EXPECT_TRUE(absl::IsNotFound(client().RemoveRobot("nowhere", "scout", 0, true)));
}

TEST_P(MissionContract, TheMapShowsWhatWasSeen) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  std::vector<Observation> batch = LookAround(8);
  Observation gas = GasAt(9, 1.0);
  batch.push_back(gas);
  ASSERT_TRUE(SendAll(*stream, batch).ok());

  const absl::StatusOr<MapSnapshot> map = client().GetMap("house");

  ASSERT_TRUE(map.ok()) << map.status();
  const GridGeometry& geometry = map->occupancy.geometry();
  EXPECT_EQ(map->occupancy.At(geometry.CellAt({1.0, 0.0}), CellState::kUnknown), CellState::kFree);
  EXPECT_EQ(map->occupancy.At(geometry.CellAt({7.0, 0.0}), CellState::kUnknown),
            CellState::kUnknown);
  ASSERT_EQ(map->robots.size(), 1U);
  EXPECT_EQ(map->robots[0].id, "scout");
  EXPECT_EQ(map->robots[0].applied_sequence, 9);
  EXPECT_EQ(map->robots[0].pose.x_m, 1.0);
  EXPECT_EQ(map->gas_counters.readings, 1);
}

TEST_P(MissionContract, DeletingAMissionEndsItsStreams) {
  const RobotSession session = Register();
  const auto stream = Open(session);

  ASSERT_TRUE(client().DeleteMission("house").ok());

  EXPECT_TRUE(absl::IsNotFound(ReadUntilError(*stream)));
  EXPECT_TRUE(absl::IsNotFound(client().OpenObservationStream(session).status()));
}

INSTANTIATE_TEST_SUITE_P(All, MissionContract, ::testing::ValuesIn(AllBackends()), BackendName);

}  // namespace mission_contract_test
}  // namespace plumescout::client
