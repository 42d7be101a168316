// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/ingest_service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>

#include "absl/time/clock.h"
#include "tests/server/await_metric.h"
#include "tests/server/service_fixture.h"
#include "tests/server/writer_gate.h"

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
  WriterGate gate;
  StartServer(config, gate.Hooks());
  const std::int64_t lease = Lease();
  auto held = std::async(std::launch::async,
                         [&] { return Ingest(kRobot, lease, GasReadings(1, 1)).status(); });
  gate.AwaitHeld();
  // Whichever comes first waits; there is no room for the other.
  absl::Status refused;
  const auto ingest = [&] {
    const absl::Status status = Ingest(kRobot, lease, GasReadings(2, 3)).status();
    if (!status.ok()) {
      refused = status;
      gate.Release();
    }
    return status.ok();
  };
  auto one = std::async(std::launch::async, ingest);
  auto other = std::async(std::launch::async, ingest);
  EXPECT_NE(one.get(), other.get());
  EXPECT_TRUE(held.get().ok());
  EXPECT_THAT(refused, Refuses(absl::StatusCode::kResourceExhausted, "OVERLOADED"));
  EXPECT_TRUE(RetryDelay(refused).has_value());
}

TEST_F(ServiceTest, ABatchHasArrivedWithItsCallThoughTheWriterIsBusy) {
  WriterGate gate;
  StartServer({}, gate.Hooks());
  const std::int64_t lease = Lease();
  const auto other = Register("r2");
  ASSERT_TRUE(other.ok()) << other.status();
  auto held =
      std::async(std::launch::async, [&] { return Ingest(kRobot, lease, GasReadings(1, 1)); });
  gate.AwaitHeld();
  v1::ObservationBatch batch = GasReadings(1, 1);
  const absl::Time sent = absl::Now() - absl::Hours(1);  // by a clock that is slow
  batch.set_sent_time_ns(absl::ToUnixNanos(sent));
  auto waiting = std::async(std::launch::async,
                            [&] { return Ingest(other->robot(), other->lease_token(), batch); });
  EXPECT_TRUE(
      AwaitMetric(*server_, "plumescout_mission_reserved_observations{mission=\"hall\"} 1"));
  const absl::Time queued = absl::Now();
  gate.Release();
  EXPECT_TRUE(held.get().ok());
  EXPECT_TRUE(waiting.get().ok());
  v1::GetRobotRequest request;
  request.set_name(other->robot());
  const auto robot = Call(robots_, &v1::RobotService::Stub::GetRobot, request);
  ASSERT_TRUE(robot.ok()) << robot.status();
  EXPECT_GE(robot->robot().clock_offset_s(), absl::ToDoubleSeconds(absl::Hours(1)));
  EXPECT_LE(robot->robot().clock_offset_s(), absl::ToDoubleSeconds(queued - sent));
}

TEST_F(ServiceTest, ABatchAboveTheRatesIsRefusedWhole) {
  ServerConfig config;
  config.limits.max_gas_readings_per_s = 0.05;
  config.limits.ingest_burst_s = 60.0;  // three at once
  StartServer(config);
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(1, 2)).ok());
  const absl::Status refused = Ingest(kRobot, lease, GasReadings(3, 5)).status();
  EXPECT_THAT(refused, Refuses(absl::StatusCode::kResourceExhausted, "RATE_EXCEEDED"));
  EXPECT_GT(RetryDelay(refused).value(), absl::Seconds(1));
  EXPECT_EQ(Revision(), 3);
}

// A clock 20 h ahead does not take the time of the mission along.
TEST_F(ServiceTest, ASampleFromTheFutureIsRefusedAndTheNextOnesCount) {
  StartServer();
  const std::int64_t lease = Lease();
  const std::int64_t now_ns = absl::GetCurrentTimeNanos();
  v1::ObservationBatch batch = GasReadings(1, 3);
  for (v1::Observation& reading : *batch.mutable_observations()) {
    reading.set_sample_time_ns(now_ns);
  }
  batch.mutable_observations(1)->set_sample_time_ns(now_ns + 72'000'000'000'000);
  const auto response = Ingest(kRobot, lease, batch);
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->ingest_state().applied_sequence(), 3);
  ASSERT_THAT(response->rejections(), SizeIs(1));
  EXPECT_EQ(response->rejections(0).sequence(), 2);
  const absl::Status refused = FromProto(response->rejections(0).status());
  EXPECT_THAT(refused, Refuses(absl::StatusCode::kInvalidArgument, "CLOCK_AHEAD"));
  EXPECT_THAT(refused, RefusesField("observation.sample_time_ns"));
}

TEST_F(ServiceTest, AMissionMayTakeSamplesFromTheFutureAsOfNow) {
  ServerConfig config;
  config.mission.stamp_by_arrival = true;
  StartServer(config);
  v1::ObservationBatch batch = GasReadings(1, 1);
  const std::int64_t before_ns = absl::GetCurrentTimeNanos();
  batch.mutable_observations(0)->set_sample_time_ns(before_ns + 72'000'000'000'000);
  const auto response = Ingest(kRobot, Lease(), batch);
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_THAT(response->rejections(), IsEmpty());
  v1::QueryGasRequest query;
  query.set_mission("missions/hall");
  query.add_points();
  query.set_fresh_posterior(true);
  const auto gas = Call(maps_, &v1::MapService::Stub::QueryGas, query);
  ASSERT_TRUE(gas.ok()) << gas.status();
  EXPECT_GE(gas->posterior_time_ns(), before_ns);
  EXPECT_LE(gas->posterior_time_ns(), absl::GetCurrentTimeNanos());
}

}  // namespace ingest_service_test
}  // namespace plumescout::server
