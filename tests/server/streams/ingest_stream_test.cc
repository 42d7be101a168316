// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/ingest_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "tests/server/await_metric.h"
#include "tests/server/service_fixture.h"
#include "tests/server/writer_gate.h"

namespace plumescout::server {
namespace ingest_stream_test {

constexpr auto kNotFound = absl::StatusCode::kNotFound;
constexpr auto kPrecondition = absl::StatusCode::kFailedPrecondition;
constexpr int kWindow = LimitConfig{}.stream_window_observations;

class IngestStreamTest : public ServiceTest {
 protected:
  void SetUp() override {
    ServerConfig config;
    config.limits.max_gas_readings_per_s = 0.0;
    StartServer(config);
    lease_ = Lease();
  }
  // A stream that is open, its greeting read.
  std::unique_ptr<IngestClient> OpenStream() {
    auto stream = std::make_unique<IngestClient>(*ingest_);
    EXPECT_TRUE(stream->Open(kRobot, lease_));
    EXPECT_TRUE(stream->Read().has_opened());
    return stream;
  }
  // What the server says to a stream that opens like this.
  absl::Status OpenWith(const std::string& robot, std::int64_t lease) {
    IngestClient stream(*ingest_);
    stream.Open(robot, lease);
    return stream.Finish();
  }

  std::int64_t lease_ = 0;
};

TEST_F(IngestStreamTest, GreetingSaysWhereTheLogStands) {
  ASSERT_TRUE(Ingest(kRobot, lease_, GasReadings(1, 5)).ok());
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, lease_));
  const v1::IngestOpened opened = stream.Read().opened();
  EXPECT_EQ(opened.server_boot_id(), server_->boot_id());
  EXPECT_EQ(opened.ingest_state().applied_sequence(), 5);
  EXPECT_EQ(opened.ingest_state().credit_sequence(), 5 + kWindow);
  EXPECT_EQ(opened.ingest_state().revision(), 6);
}

TEST_F(IngestStreamTest, BatchesAreAcknowledgedWithNewCredit) {
  const auto stream = OpenStream();
  ASSERT_TRUE(stream->Send(GasReadings(1, 3)));
  ASSERT_TRUE(stream->Send(GasReadings(4, 6)));
  const v1::IngestState ack = stream->ReadAck(6);
  EXPECT_EQ(ack.applied_sequence(), 6);
  EXPECT_EQ(ack.credit_sequence(), 6 + kWindow);
  EXPECT_EQ(ack.revision(), 7);
}

TEST_F(IngestStreamTest, RepeatsAreAcknowledgedAgainAndChangeNothing) {
  const auto stream = OpenStream();
  ASSERT_TRUE(stream->Send(GasReadings(1, 3)));
  ASSERT_EQ(stream->ReadAck(3).applied_sequence(), 3);
  ASSERT_TRUE(stream->Send(GasReadings(1, 3)));
  const v1::IngestState ack = stream->ReadAck(3);
  EXPECT_EQ(ack.applied_sequence(), 3);
  EXPECT_EQ(ack.revision(), 4);
}

TEST_F(IngestStreamTest, HoleEndsTheStreamAfterWhatCameBeforeIsAcknowledged) {
  const auto stream = OpenStream();
  v1::ObservationBatch batch = GasReadings(1, 2);
  *batch.add_observations() = GasReadings(4, 4).observations(0);
  ASSERT_TRUE(stream->Send(batch));
  EXPECT_EQ(stream->ReadAck(2).applied_sequence(), 2);
  const absl::Status ended = stream->Finish();
  EXPECT_THAT(ended, Refuses(kPrecondition, "SEQUENCE_GAP"));
  EXPECT_EQ(ReasonMetadata(ended).at("expected"), "3");
}

TEST_F(IngestStreamTest, BrokenStreamGoesOnWhereTheLogStands) {
  auto stream = OpenStream();
  ASSERT_TRUE(stream->Send(GasReadings(1, 3)));
  ASSERT_EQ(stream->ReadAck(3).applied_sequence(), 3);
  stream->Cancel();
  EXPECT_TRUE(absl::IsCancelled(stream->Finish()));
  IngestClient reopened(*ingest_);
  ASSERT_TRUE(reopened.Open(kRobot, lease_));
  EXPECT_EQ(reopened.Read().opened().ingest_state().applied_sequence(), 3);
  ASSERT_TRUE(reopened.Send(GasReadings(2, 5)));
  EXPECT_EQ(reopened.ReadAck(5).revision(), 6);
}

TEST_F(IngestStreamTest, RefusedObservationIsNamedAndTheStreamGoesOn) {
  const auto stream = OpenStream();
  v1::ObservationBatch batch = GasReadings(1, 2);
  batch.mutable_observations(0)->clear_payload();
  ASSERT_TRUE(stream->Send(batch));
  const v1::ObservationRejected rejected = stream->Read().rejected();
  EXPECT_EQ(rejected.sequence(), 1);
  EXPECT_THAT(FromProto(rejected.status()), RefusesField("observation.payload"));
  ASSERT_TRUE(stream->Send(GasReadings(3, 3)));
  EXPECT_EQ(stream->ReadAck(3).applied_sequence(), 3);
}

TEST_F(IngestStreamTest, NewerStreamTakesThePlaceOfTheOlder) {
  const auto older = OpenStream();
  const auto newer = OpenStream();
  EXPECT_THAT(older->Finish(), Refuses(absl::StatusCode::kAborted, "STREAM_REPLACED"));
  ASSERT_TRUE(newer->Send(GasReadings(1, 1)));
  EXPECT_EQ(newer->ReadAck(1).applied_sequence(), 1);
}

TEST_F(IngestStreamTest, NewerRegistrationEndsTheStreamAndFencesItsLease) {
  const auto stream = OpenStream();
  ASSERT_TRUE(Register("r1", /*take_over=*/true).ok());
  EXPECT_THAT(stream->Finish(), Refuses(kPrecondition, "LEASE_SUPERSEDED"));
  EXPECT_THAT(OpenWith(kRobot, lease_), Refuses(kPrecondition, "LEASE_SUPERSEDED"));
}

TEST_F(IngestStreamTest, StrangersAreNotFound) {
  EXPECT_THAT(OpenWith("missions/hall/robots/r2", lease_), Refuses(kNotFound, "ROBOT_NOT_FOUND"));
  EXPECT_THAT(OpenWith("missions/attic/robots/r1", lease_),
              Refuses(kNotFound, "MISSION_NOT_FOUND"));
  EXPECT_THAT(OpenWith("r1", lease_), RefusesField("open.robot"));
}

TEST_F(IngestStreamTest, FirstFrameOpensAndNoOther) {
  IngestClient eager(*ingest_);
  eager.Send(GasReadings(1, 1));
  EXPECT_THAT(eager.Finish(), RefusesField("open"));
  const auto twice = OpenStream();
  twice->Open(kRobot, lease_);
  EXPECT_THAT(twice->Finish(), RefusesField("open"));
  const auto empty = OpenStream();
  empty->Write({});
  EXPECT_THAT(empty->Finish(), RefusesField("frame"));
}

TEST_F(IngestStreamTest, BatchBeyondTheCreditEndsTheStreamUnapplied) {
  const auto stream = OpenStream();
  stream->Send(GasReadings(1, kWindow + 1));
  const absl::Status ended = stream->Finish();
  EXPECT_THAT(ended, Refuses(absl::StatusCode::kResourceExhausted, "CREDIT_EXCEEDED"));
  EXPECT_TRUE(RetryDelay(ended).has_value());
  EXPECT_EQ(Revision(), 1);
}

TEST_F(IngestStreamTest, HalfCloseEndsTheStreamAfterTheLastAcknowledgement) {
  const auto stream = OpenStream();
  ASSERT_TRUE(stream->Send(GasReadings(1, 3)));
  stream->HalfClose();
  EXPECT_EQ(stream->ReadAck(3).applied_sequence(), 3);
  EXPECT_TRUE(stream->Finish().ok());
}

TEST_F(IngestStreamTest, RobotThatDoesNotReadGetsTheNewestAcknowledgementLast) {
  constexpr int kBatches = 400;
  const auto stream = OpenStream();
  for (int i = 0; i < kBatches; ++i) ASSERT_TRUE(stream->Send(GasReadings(1, kWindow)));
  stream->HalfClose();
  int acks = 0;
  v1::IngestState last;
  for (auto frame = stream->Read(); frame.has_ack(); frame = stream->Read()) {
    ++acks;
    last = frame.ack();
  }
  EXPECT_LE(acks, kBatches);
  EXPECT_EQ(last.applied_sequence(), kWindow);
  EXPECT_EQ(last.revision(), Revision());
  EXPECT_TRUE(stream->Finish().ok());
}

TEST_F(IngestStreamTest, DeletedMissionEndsTheStream) {
  const auto stream = OpenStream();
  ASSERT_TRUE(DeleteMission("hall").ok());
  EXPECT_THAT(stream->Finish(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
}

// Robots r0, r1 ... with a stream each.
std::vector<std::unique_ptr<IngestClient>> OpenStreams(
    int count, v1::IngestService::Stub& stub,
    const std::function<std::int64_t(const std::string&)>& lease_of) {
  std::vector<std::unique_ptr<IngestClient>> streams;
  for (int i = 0; i < count; ++i) {
    const std::string robot = absl::StrCat("r", i);
    streams.push_back(std::make_unique<IngestClient>(stub));
    EXPECT_TRUE(
        streams.back()->Open(absl::StrCat("missions/hall/robots/", robot), lease_of(robot)));
    EXPECT_TRUE(streams.back()->Read().has_opened()) << robot;
  }
  return streams;
}

TEST_F(ServiceTest, StreamsTakeNoRoomBeforeTheySend) {
  constexpr int kRobots = 200;
  ServerConfig config;
  config.mission.max_robot_count = kRobots;
  config.limits.max_streams_per_connection = 2 * kRobots;
  StartServer(config);
  const auto streams = OpenStreams(
      kRobots, *ingest_, [&](const std::string& robot) { return Register(robot)->lease_token(); });
  for (const auto& stream : streams) ASSERT_TRUE(stream->Send(GasReadings(1, 1)));
  for (const auto& stream : streams) EXPECT_EQ(stream->ReadAck(1).applied_sequence(), 1);
}

TEST_F(ServiceTest, BatchesWaitForRoomAndNoneIsRefused) {
  ServerConfig config;
  config.limits.max_queued_observations = kWindow;
  WriterGate gate;
  StartServer(config, gate.Hooks());
  const auto streams = OpenStreams(
      5, *ingest_, [&](const std::string& robot) { return Register(robot)->lease_token(); });
  ASSERT_TRUE(streams[0]->Send(GasReadings(1, 1)));
  gate.AwaitHeld();
  for (const auto& stream : streams) {
    ASSERT_TRUE(stream->Send(GasReadings(1, kWindow / 2)));
    ASSERT_TRUE(stream->Send(GasReadings(kWindow / 2 + 1, kWindow)));
  }
  streams[4]->Cancel();  // who gives up while it waits leaves its place to others
  EXPECT_TRUE(absl::IsCancelled(streams[4]->Finish()));
  gate.Release();
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(streams[i]->ReadAck(kWindow).applied_sequence(), kWindow);
  }
}

// Room is given by whichever thread gives some back, while the stream's own threads go on.
TEST_F(ServiceTest, BatchesThatWaitForRoomKeepTheirOrder) {
  constexpr int kRobots = 6;
  constexpr int kRounds = 5;
  ServerConfig config;
  config.limits.max_queued_observations = 2;
  StartServer(config);
  const auto streams = OpenStreams(
      kRobots, *ingest_, [&](const std::string& robot) { return Register(robot)->lease_token(); });
  std::vector<std::future<std::int64_t>> applied;
  for (const auto& stream : streams) {
    applied.push_back(std::async(std::launch::async, [&stream] {
      std::int64_t applied_sequence = 0;
      for (int last = kWindow; last <= kRounds * kWindow; last += kWindow) {
        for (int i = last - kWindow + 1; i <= last; ++i) stream->Send(GasReadings(i, i));
        applied_sequence = stream->ReadAck(last).applied_sequence();
        if (applied_sequence < last) break;
      }
      return applied_sequence;
    }));
  }
  for (int i = 0; i < kRobots; ++i) {
    EXPECT_EQ(applied[static_cast<std::size_t>(i)].get(), kRounds * kWindow)
        << streams[static_cast<std::size_t>(i)]->Finish();
  }
}

TEST_F(ServiceTest, ABatchHasArrivedWhenItsFrameHasThoughTheWriterIsBusy) {
  WriterGate gate;
  StartServer({}, gate.Hooks());
  const auto streams = OpenStreams(
      2, *ingest_, [&](const std::string& robot) { return Register(robot)->lease_token(); });
  ASSERT_TRUE(streams[0]->Send(GasReadings(1, 1)));
  gate.AwaitHeld();
  v1::ObservationBatch batch = GasReadings(1, 1);
  const absl::Time sent = absl::Now() - absl::Hours(1);  // by a clock that is slow
  batch.set_sent_time_ns(absl::ToUnixNanos(sent));
  ASSERT_TRUE(streams[1]->Send(batch));
  EXPECT_TRUE(
      AwaitMetric(*server_, "plumescout_mission_reserved_observations{mission=\"hall\"} 1"));
  const absl::Time queued = absl::Now();
  gate.Release();
  EXPECT_EQ(streams[1]->ReadAck(1).applied_sequence(), 1);
  v1::GetRobotRequest request;
  request.set_name("missions/hall/robots/r1");
  const auto robot = Call(robots_, &v1::RobotService::Stub::GetRobot, request);
  ASSERT_TRUE(robot.ok()) << robot.status();
  EXPECT_GE(robot->robot().clock_offset_s(), absl::ToDoubleSeconds(absl::Hours(1)));
  EXPECT_LE(robot->robot().clock_offset_s(), absl::ToDoubleSeconds(queued - sent));
}

TEST_F(ServiceTest, DeletedMissionEndsStreamsThoughItIsBusy) {
  WriterGate gate;
  StartServer({}, gate.Hooks());
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, Lease()));
  ASSERT_TRUE(stream.Read().has_opened());
  ASSERT_TRUE(stream.Send(GasReadings(1, 1)));
  gate.AwaitHeld();
  ASSERT_TRUE(stream.Send(GasReadings(2, 2)));
  auto deleted = std::async(std::launch::async, [&] { return DeleteMission("hall"); });
  EXPECT_THAT(stream.Finish(), Refuses(kNotFound, "MISSION_NOT_FOUND"));
  gate.Release();
  EXPECT_TRUE(deleted.get().ok());
}

TEST_F(ServiceTest, AStreamAboveTheRatesIsReadMoreSlowly) {
  constexpr int kReadings = 30;
  constexpr double kRate_per_s = 50.0;
  constexpr double kBurst_s = 1.0;
  ServerConfig config;
  config.limits.max_gas_readings_per_s = kRate_per_s;
  config.limits.ingest_burst_s = kBurst_s;
  StartServer(config);
  const int burst = static_cast<int>(kRate_per_s * kBurst_s);
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, Lease()));
  ASSERT_TRUE(stream.Read().has_opened());
  const absl::Time begun = absl::Now();
  for (int i = 1; i <= burst + kReadings; ++i) ASSERT_TRUE(stream.Send(GasReadings(i, i)));
  EXPECT_EQ(stream.ReadAck(burst + kReadings).applied_sequence(), burst + kReadings);
  // The frame that goes beyond the rate is taken before the pause.
  EXPECT_GE(absl::Now() - begun, absl::Seconds((kReadings - 1) / kRate_per_s));
}

}  // namespace ingest_stream_test
}  // namespace plumescout::server
