// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Streams of observations.
#include "tests/client/planner_client_contract.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "client/error_reason.h"

namespace plumescout::client {
namespace ingest_contract_test {

class IngestContract : public PlannerClientContract {};

TEST_P(IngestContract, ObservationsAreAcknowledgedAndNeverDurableYet) {
  const RobotSession session = Register();
  const auto stream = Open(session);

  const absl::StatusOr<LogReplies> sent = SendAll(*stream, GasRange(1, 20));
  ASSERT_TRUE(sent.ok()) << sent.status();

  EXPECT_EQ(sent->state.applied_sequence, 20);
  EXPECT_EQ(sent->state.durable_sequence, 0);
  EXPECT_GT(sent->state.credit_sequence, 20);
  EXPECT_GE(sent->state.revision, 20);
}

TEST_P(IngestContract, RepeatedObservationsAreAcknowledgedOnceMoreAndCountOnce) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(SendAll(*stream, GasRange(1, 5)).ok());

  const absl::StatusOr<LogReplies> sent = SendAll(*stream, GasRange(3, 8));
  ASSERT_TRUE(sent.ok()) << sent.status();

  EXPECT_EQ(client().GetMap("house")->gas_counters.readings, 8);
}

TEST_P(IngestContract, AHoleEndsTheStreamAndNamesTheNumberExpected) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(SendAll(*stream, GasRange(1, 2)).ok());

  stream->Write({GasAt(4)}).IgnoreError();  // the error may meet the write or a later read
  const absl::Status status = ReadUntilError(*stream);

  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_EQ(ErrorReason(status), kSequenceGap);
  EXPECT_THAT(std::string(status.message()), ::testing::HasSubstr("3"));
}

TEST_P(IngestContract, ADeclaredGapMovesTheLogOn) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  Observation gap = GasAt(1);
  gap.payload = SequenceGap{1, 40};

  const absl::StatusOr<LogReplies> sent = SendAll(*stream, {gap, GasAt(41)});
  ASSERT_TRUE(sent.ok()) << sent.status();

  EXPECT_EQ(sent->state.applied_sequence, 41);
  EXPECT_EQ(client().GetMap("house")->gas_counters.readings, 1);
}

TEST_P(IngestContract, ABadObservationIsRefusedAloneAndCountsAsApplied) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  std::vector<Observation> batch = GasRange(1, 3);
  batch[1].pose.x_m = 1e9;  // beyond every mission's limit

  const absl::StatusOr<LogReplies> sent = SendAll(*stream, batch);
  ASSERT_TRUE(sent.ok()) << sent.status();

  ASSERT_EQ(sent->refused.size(), 1U);
  EXPECT_EQ(sent->refused[0].sequence, 2);
  EXPECT_FALSE(sent->refused[0].status.ok());
  EXPECT_EQ(sent->state.applied_sequence, 3);
  EXPECT_EQ(client().GetMap("house")->robots[0].rejected_observations, 1);
}

TEST_P(IngestContract, ObservationsBeyondTheCreditEndTheStream) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  const std::int64_t credit = stream->opened().credit_sequence;
  Observation gap = GasAt(1);
  gap.payload = SequenceGap{1, credit};

  stream->Write({gap, GasAt(credit + 1)}).IgnoreError();
  const absl::Status status = ReadUntilError(*stream);

  EXPECT_TRUE(absl::IsResourceExhausted(status)) << status;
}

TEST_P(IngestContract, ReadWithoutRepliesTimesOutAndTheStreamLivesOn) {
  const RobotSession session = Register();
  const auto stream = Open(session);

  EXPECT_TRUE(absl::IsDeadlineExceeded(stream->Read(absl::ZeroDuration()).status()));
  EXPECT_TRUE(absl::IsDeadlineExceeded(stream->Read(absl::Milliseconds(5)).status()));

  EXPECT_EQ(SendAll(*stream, GasRange(1, 1)).status(), absl::OkStatus());
}

TEST_P(IngestContract, ANewStreamResumesWhereTheLogEnds) {
  const RobotSession session = Register();
  {
    const auto stream = Open(session);
    ASSERT_TRUE(SendAll(*stream, GasRange(1, 7)).ok());
    EXPECT_EQ(stream->Finish(), absl::OkStatus());
  }

  const auto stream = Open(session);

  ASSERT_NE(stream, nullptr);
  EXPECT_EQ(stream->opened().applied_sequence, 7);
  EXPECT_EQ(SendAll(*stream, GasRange(8, 9)).status(), absl::OkStatus());
}

TEST_P(IngestContract, ANewStreamOfTheSameClientReplacesItsOldOne) {
  const RobotSession session = Register();
  const auto old_stream = Open(session);

  const auto stream = Open(session);

  ASSERT_NE(stream, nullptr);
  EXPECT_FALSE(ReadUntilError(*old_stream).ok());
  EXPECT_EQ(SendAll(*stream, GasRange(1, 1)).status(), absl::OkStatus());
}

TEST_P(IngestContract, TwoRobotsKeepTheirOwnLogs) {
  const RobotSession one = Register("one");
  const RobotSession two = Register("two");
  const auto stream_one = Open(one);
  const auto stream_two = Open(two);

  EXPECT_EQ(SendAll(*stream_one, GasRange(1, 5)).status(), absl::OkStatus());
  EXPECT_EQ(SendAll(*stream_two, GasRange(1, 3)).status(), absl::OkStatus());

  EXPECT_EQ(Open(one)->opened().applied_sequence, 5);
  EXPECT_EQ(Open(two)->opened().applied_sequence, 3);
}

TEST_P(IngestContract, StreamsMayBeLeftUnfinished) {
  const RobotSession session = Register();
  for (int i = 0; i < 20; ++i) {
    const auto stream = Open(session);
    ASSERT_NE(stream, nullptr);
    stream->Write(GasRange(1, 50)).IgnoreError();
  }
  EXPECT_NE(Open(session), nullptr);
}

INSTANTIATE_TEST_SUITE_P(All, IngestContract, ::testing::ValuesIn(AllBackends()), BackendName);

}  // namespace ingest_contract_test
}  // namespace plumescout::client
