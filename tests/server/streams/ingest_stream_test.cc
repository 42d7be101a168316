// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/ingest_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace ingest_stream_test {

constexpr auto kNotFound = absl::StatusCode::kNotFound;
constexpr auto kPrecondition = absl::StatusCode::kFailedPrecondition;
constexpr int kWindow = LimitConfig{}.stream_window_observations;

class IngestStreamTest : public ServiceTest {
 protected:
  void SetUp() override {
    StartServer();
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
  constexpr int kBatches = 500;
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

TEST_F(ServiceTest, StreamsReserveRoomInTheQueueForTheirWindow) {
  ServerConfig config;
  config.limits.max_queued_observations = kWindow;
  StartServer(config);
  IngestClient first(*ingest_);
  ASSERT_TRUE(first.Open(kRobot, Lease()));
  ASSERT_TRUE(first.Read().has_opened());
  IngestClient second(*ingest_);
  ASSERT_TRUE(second.Open("missions/hall/robots/r2", Register("r2")->lease_token()));
  EXPECT_THAT(second.Finish(), Refuses(absl::StatusCode::kResourceExhausted, "OVERLOADED"));
}

}  // namespace ingest_stream_test
}  // namespace plumescout::server
