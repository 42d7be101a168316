// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The real server is killed in the middle of a mission and started again on the same folder: what
// it said is durable is there, and robots go on as if nothing had happened.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <thread>

#include "absl/time/clock.h"
#include "tests/e2e/server_program.h"
#include "tests/server/missions/recorded_files.h"
#include "tests/server/service_fixture.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace server_crash_test {

class ServerCrashTest : public ServiceTest {
 protected:
  void StartProgram() {
    program_ = std::make_unique<e2e::ServerProgram>(
        std::vector<std::string>{"--store", "sqlite", "--data", folder_.path(), "--record",
                                 folder_.File("recorded"), "--set", "record.chunk_s=0.1"},
        STDERR_FILENO);
    ASSERT_TRUE(program_->listens());
    Connect(program_->target());
  }
  // As kill -9 does.
  void Kill() { program_.reset(); }
  // Returns the mission once it is in memory.
  v1::Mission AwaitRecovered() {
    v1::GetMissionRequest request;
    request.set_name("missions/hall");
    const absl::Time deadline = absl::Now() + absl::Seconds(60);
    absl::StatusOr<v1::GetMissionResponse> response = absl::UnavailableError("");
    while (absl::IsUnavailable(response.status()) && absl::Now() < deadline) {
      response = Call(missions_, &v1::MissionService::Stub::GetMission, request);
      std::this_thread::yield();
    }
    EXPECT_TRUE(response.ok()) << response.status();
    return response.ok() ? response->mission() : v1::Mission();
  }

  const TempFolder folder_;
  std::unique_ptr<e2e::ServerProgram> program_;
};

TEST_F(ServerCrashTest, WhatWasAcknowledgedIsThereAgain) {
  StartProgram();
  ASSERT_TRUE(CreateMission("hall").ok());
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
  std::int64_t sequence = 1;
  for (int life = 1; life <= 3; ++life) {
    const auto sent = Ingest(kRobot, lease, GasReadings(sequence + 1, sequence + 20));
    ASSERT_TRUE(sent.ok()) << sent.status();
    sequence += 20;
    EXPECT_EQ(sent->ingest_state().durable_sequence(), sequence);
    v1::NextBestTrajectoryRequest order = PlanFor(lease);
    order.mutable_planning_budget()->set_seconds(1);
    const auto plan = NextBest(order);
    ASSERT_TRUE(plan.ok()) << plan.status();
    EXPECT_EQ(plan->plan().name(), absl::StrCat("missions/hall/plans/", life));
    const auto map = GetMap(/*full_precision=*/true);
    ASSERT_TRUE(map.ok()) << map.status();
    const std::int64_t revision = Revision();
    Kill();
    StartProgram();
    EXPECT_EQ(AwaitRecovered().revision(), revision);
    EXPECT_EQ(GetMap(/*full_precision=*/true)->SerializeAsString(), map->SerializeAsString());
  }
}

// But for what came in the last moments. The recording thread looks at its chunks every second.
TEST_F(ServerCrashTest, TheRecordingOfAKilledServerIsReadUpToItsLastChunk) {
  StartProgram();
  ASSERT_TRUE(CreateMission("hall").ok());
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(2, 21)).ok());
  const std::string path = folder_.File("recorded/hall.1.mcap");
  const absl::Time deadline = absl::Now() + absl::Seconds(60);
  RecordedFile file;
  while (file.events.size() < 22 && absl::Now() < deadline) {
    absl::SleepFor(absl::Milliseconds(50));
    if (McapReader::Open(path).ok()) file = ReadRecording(path);
  }
  Kill();
  file = ReadRecording(path);
  EXPECT_GE(file.events.size(), 22u);  // the robot's registration as well
  EXPECT_THAT(file.torn_end, testing::HasSubstr("cut off"));
  EXPECT_EQ(file.by_topic.at("/robots/r1/gas").size(), 20u);
}

// Whatever comes of a batch whose answer was lost, nothing is lost or counted twice.
TEST_F(ServerCrashTest, AStreamThatIsCutGoesOnWhereTheServerStands) {
  StartProgram();
  ASSERT_TRUE(CreateMission("hall").ok());
  const std::int64_t lease = Lease();
  std::int64_t durable = 0;
  {
    IngestClient stream(*ingest_);
    ASSERT_TRUE(stream.Open(kRobot, lease));
    ASSERT_TRUE(stream.Read().has_opened());
    ASSERT_TRUE(stream.Send(GasReadings(1, 50)));
    while (durable == 0) durable = stream.Read().ack().durable_sequence();
    ASSERT_TRUE(stream.Send(GasReadings(51, 100)));
    Kill();
    EXPECT_FALSE(stream.Finish().ok());
  }
  EXPECT_EQ(durable, 50);
  StartProgram();
  AwaitRecovered();
  IngestClient stream(*ingest_);
  v1::StreamObservationsRequest open;
  open.mutable_open()->set_robot(kRobot);
  open.mutable_open()->set_lease_token(lease);
  open.mutable_open()->set_durable_sequence(durable);
  ASSERT_TRUE(stream.Write(open));
  const v1::IngestState state = stream.Read().opened().ingest_state();
  EXPECT_GE(state.applied_sequence(), durable);
  EXPECT_EQ(state.durable_sequence(), state.applied_sequence()) << "what came back is durable";
  ASSERT_TRUE(stream.Send(GasReadings(1, 100)));
  EXPECT_EQ(stream.ReadAck(100).applied_sequence(), 100);
  stream.HalfClose();
  EXPECT_TRUE(stream.Finish().ok());
}

TEST_F(ServerCrashTest, ATerminatedServerLosesNothing) {
  StartProgram();
  ASSERT_TRUE(CreateMission("hall").ok());
  const std::int64_t lease = Lease();
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, lease));
  ASSERT_TRUE(stream.Read().has_opened());
  ASSERT_TRUE(stream.Send(GasReadings(1, 100)));
  EXPECT_EQ(stream.ReadAck(100).applied_sequence(), 100);  // and perhaps not durable yet
  program_->Terminate();
  EXPECT_EQ(program_->AwaitExit(absl::Seconds(60)), 0);
  stream.Finish().IgnoreError();
  StartProgram();
  AwaitRecovered();
  EXPECT_EQ(GetMap()->status().robots(0).applied_sequence(), 100);
}

}  // namespace server_crash_test
}  // namespace plumescout::server
