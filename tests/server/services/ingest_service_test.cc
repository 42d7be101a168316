// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/ingest_service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace ingest_service_test {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr auto kNotFound = absl::StatusCode::kNotFound;
constexpr auto kPrecondition = absl::StatusCode::kFailedPrecondition;

class IngestServiceTest : public ServiceTest {
 protected:
  void SetUp() override {
    StartServer();
    lease_ = Lease();
  }
  absl::StatusOr<v1::BatchIngestObservationsResponse> Send(const v1::ObservationBatch& batch) {
    return Ingest(kRobot, lease_, batch);
  }

  std::int64_t lease_ = 0;
};

TEST_F(IngestServiceTest, BatchMovesTheLogAndSaysHowFar) {
  const auto response = Send(GasReadings(1, 3));
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_THAT(response->rejections(), IsEmpty());
  EXPECT_EQ(response->ingest_state().applied_sequence(), 3);
  EXPECT_EQ(response->ingest_state().durable_sequence(), 0);
  EXPECT_EQ(response->ingest_state().credit_sequence(), 3 + LimitConfig{}.max_batch_observations);
  EXPECT_EQ(response->ingest_state().revision(), 4);  // the registration and three readings
  EXPECT_EQ(Revision(), 4);
}

TEST_F(IngestServiceTest, RepeatedBatchIsAcknowledgedAgainAndChangesNothing) {
  ASSERT_TRUE(Send(GasReadings(1, 3)).ok());
  const auto repeated = Send(GasReadings(1, 3));
  ASSERT_TRUE(repeated.ok()) << repeated.status();
  EXPECT_EQ(repeated->ingest_state().applied_sequence(), 3);
  EXPECT_EQ(repeated->ingest_state().revision(), 4);
}

TEST_F(IngestServiceTest, OverlapIsAppliedOnce) {
  ASSERT_TRUE(Send(GasReadings(1, 3)).ok());
  const auto overlapping = Send(GasReadings(2, 5));
  ASSERT_TRUE(overlapping.ok()) << overlapping.status();
  EXPECT_EQ(overlapping->ingest_state().applied_sequence(), 5);
  EXPECT_EQ(overlapping->ingest_state().revision(), 6);
}

TEST_F(IngestServiceTest, HoleIsRefusedWithTheNumberExpected) {
  ASSERT_TRUE(Send(GasReadings(1, 3)).ok());
  const absl::Status refused = Send(GasReadings(5, 6)).status();
  EXPECT_THAT(refused, Refuses(kPrecondition, "SEQUENCE_GAP"));
  EXPECT_EQ(ReasonMetadata(refused).at("expected"), "4");
  EXPECT_EQ(Revision(), 4);
}

TEST_F(IngestServiceTest, DeclaredGapFillsTheHole) {
  v1::ObservationBatch batch;
  *batch.add_observations() = ToProto(Observation{1, 0, {}, SequenceGap{1, 4}});
  *batch.add_observations() = GasReadings(5, 5).observations(0);
  const auto response = Send(batch);
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->ingest_state().applied_sequence(), 5);
}

TEST_F(IngestServiceTest, RefusedObservationIsNamedAndTheOthersApplied) {
  v1::ObservationBatch batch = GasReadings(1, 3);
  batch.mutable_observations(1)->mutable_gas()->set_concentration_ppm(-1.0);
  const auto response = Send(batch);
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->ingest_state().applied_sequence(), 3);
  ASSERT_THAT(response->rejections(), SizeIs(1));
  EXPECT_EQ(response->rejections(0).sequence(), 2);
  EXPECT_THAT(FromProto(response->rejections(0).status()),
              RefusesField("observation.gas.concentration_ppm"));
}

TEST_F(IngestServiceTest, OldLeaseWritesNothing) {
  ASSERT_TRUE(Register("r1", /*take_over=*/true).ok());
  EXPECT_THAT(Send(GasReadings(1, 1)).status(), Refuses(kPrecondition, "LEASE_SUPERSEDED"));
  EXPECT_EQ(Revision(), 2);  // the two registrations
}

TEST_F(IngestServiceTest, StrangersAreNotFound) {
  const v1::ObservationBatch batch = GasReadings(1, 1);
  EXPECT_THAT(Ingest("missions/hall/robots/r2", lease_, batch).status(),
              Refuses(kNotFound, "ROBOT_NOT_FOUND"));
  EXPECT_THAT(Ingest("missions/attic/robots/r1", lease_, batch).status(),
              Refuses(kNotFound, "MISSION_NOT_FOUND"));
  EXPECT_THAT(Ingest("missions/hall", lease_, batch).status(), RefusesField("open.robot"));
}

TEST_F(IngestServiceTest, StreamsAreServedToo) {
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, lease_));
  EXPECT_TRUE(stream.Read().has_opened());
}

TEST_F(ServiceTest, FullIngestQueueSaysWhenToRetry) {
  ServerConfig config;
  config.limits.max_queued_observations = 2;
  StartServer(config);
  const absl::Status refused = Ingest(kRobot, Lease(), GasReadings(1, 3)).status();
  EXPECT_THAT(refused, Refuses(absl::StatusCode::kResourceExhausted, "OVERLOADED"));
  EXPECT_TRUE(RetryDelay(refused).has_value());
}

}  // namespace ingest_service_test
}  // namespace plumescout::server
