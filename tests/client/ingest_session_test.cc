// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ingest_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "client/error_reason.h"
#include "proto/convert/status.h"
#include "tests/client/ingest_session_fixture.h"

namespace plumescout::client {
namespace ingest_session_test {

using ::testing::ElementsAre;

class IngestSessionTest : public IngestSessionFixture {};

TEST_F(IngestSessionTest, WhatIsAppendedIsAppliedOnceAndInOrder) {
  Start();

  Append(500);

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(ReceivedNumbers(), Range(1, 500));
  EXPECT_EQ(session_->statistics().sent, 500);
}

TEST_F(IngestSessionTest, SendsNoMoreThanTheCreditInOneGo) {
  server_.set_credit_window(3);
  Start();

  Append(50);

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_LE(server_.largest_batch(), 3);
}

TEST_F(IngestSessionTest, WaitAppliedTimesOutWhileTheLinkIsDown) {
  Start();
  server_.BreakLink();
  Append(1);

  const absl::Status status = session_->WaitApplied(1, absl::Milliseconds(10));

  EXPECT_TRUE(absl::IsDeadlineExceeded(status)) << status;
}

TEST_F(IngestSessionTest, ResumesWithoutLossOrRepetitionAfterTheLinkWasDown) {
  Start();
  Append(100);
  ASSERT_TRUE(WaitForAll().ok());

  server_.BreakLink();
  Append(100);
  server_.MendLink();

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(ReceivedNumbers(), Range(1, 200));
  EXPECT_GE(session_->statistics().reconnects, 1);
  EXPECT_TRUE(session_->statistics().link_up);
}

TEST_F(IngestSessionTest, NothingIsLostHoweverOftenTheLinkBreaksMidway) {
  Start();
  for (int i = 0; i < 30; ++i) {
    Append(20);
    server_.BreakLink();
    server_.MendLink();
  }

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(ReceivedNumbers(), Range(1, 600));
}

TEST_F(IngestSessionTest, ARestartedServerIsToldEverythingAgain) {
  Start();
  Append(100);
  ASSERT_TRUE(WaitForAll().ok());

  server_.Restart();
  Append(1);

  ASSERT_TRUE(AwaitAtLeast(&IngestStatistics::server_restarts, 1));
  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(ReceivedNumbers(), Range(1, 101));
  EXPECT_EQ(session_->session().server_boot_id, "boot-2");
}

TEST_F(IngestSessionTest, NumbersDroppedFromAFullLogReachARestartedServerAsAGap) {
  IngestOptions options = QuickOptions();
  options.log.max_observations = 10;
  Start(options);
  Append(10);
  ASSERT_TRUE(WaitForAll().ok());
  Append(10);
  ASSERT_TRUE(WaitForAll().ok());

  server_.Restart();
  ASSERT_TRUE(AwaitAtLeast(&IngestStatistics::server_restarts, 1));

  ASSERT_TRUE(WaitForAll().ok());
  const std::vector<Observation> received = server_.received();
  ASSERT_FALSE(received.empty());
  EXPECT_EQ(received.front().payload, (decltype(Observation::payload)(SequenceGap{1, 10})));
  EXPECT_EQ(received.size(), 11U);
  EXPECT_EQ(session_->statistics().lost, 0);
}

TEST_F(IngestSessionTest, WhatAFullLogDropsWhileTheLinkIsDownIsCountedLost) {
  IngestOptions options = QuickOptions();
  options.log.max_observations = 10;
  Start(options);
  server_.BreakLink();
  Append(25);
  server_.MendLink();

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(session_->statistics().lost, 15);
  EXPECT_EQ(ReceivedNumbers().back(), 25);
}

TEST_F(IngestSessionTest, RefusedObservationsAreReportedAndTheStreamGoesOn) {
  server_.RefuseObservation(3);
  Start();

  Append(10);

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(session_->statistics().rejected, 1);
  EXPECT_EQ(session_->statistics().reconnects, 0);
  absl::MutexLock lock(&mutex_);
  EXPECT_THAT(rejected_, ElementsAre(3));
}

TEST_F(IngestSessionTest, AReturningRobotGoesOnWhereTheServersLogEnds) {
  server_.Preload(41);
  Start();

  Append(2);

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(ReceivedNumbers(), Range(42, 43));
}

TEST_F(IngestSessionTest, ALeaseThatAnotherTookMeanwhileIsReclaimedOnceItIsFree) {
  Start();
  Append(10);
  ASSERT_TRUE(WaitForAll().ok());

  server_.BreakLink();
  server_.SupersedeLease();
  server_.MendLink();
  ASSERT_TRUE(AwaitAtLeast(&IngestStatistics::reconnects, 3));
  server_.LetGoOfLease();
  Append(1);

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(ReceivedNumbers(), Range(1, 11));
}

TEST_F(IngestSessionTest, ALeaseThatAnotherHoldsOnEndsTheSession) {
  IngestOptions options = QuickOptions();
  options.lease_patience = absl::Milliseconds(20);
  Start(options);
  Append(1);
  ASSERT_TRUE(WaitForAll().ok());
  server_.BreakLink();
  server_.SupersedeLease();
  server_.MendLink();
  Append(1);

  EXPECT_EQ(ErrorReason(session_->WaitApplied(last_, kPatience)), kLeaseSuperseded);
}

TEST_F(IngestSessionTest, TroubleThatPassesIsWaitedForAsLongAsItTakes) {
  Start();
  for (const char* trouble :
       {"STORE_UNAVAILABLE: the disk is full", "RECOVERING: 5 missions", "OVERLOADED: later"}) {
    server_.BreakLink(absl::UnavailableError(trouble));
    const std::int64_t before = session_->statistics().reconnects;
    Append(10);
    ASSERT_TRUE(AwaitAtLeast(&IngestStatistics::reconnects, before + 20));
    EXPECT_EQ(session_->health(), absl::OkStatus());
    server_.MendLink();
    ASSERT_TRUE(WaitForAll().ok());
  }
}

TEST_F(IngestSessionTest, TheServersDelayIsKeptTo) {
  Start();
  server_.BreakLink(WithRetryDelay(absl::UnavailableError("RECOVERING"), absl::Hours(1)));
  ASSERT_TRUE(AwaitAtLeast(&IngestStatistics::reconnects, 1));
  server_.MendLink();
  Append(1);

  EXPECT_TRUE(absl::IsDeadlineExceeded(session_->WaitApplied(1, absl::Milliseconds(30))));
  session_.reset();  // at once
}

TEST_F(IngestSessionTest, ASupersededLeaseEndsTheSessionForGood) {
  Start();
  Append(1);
  ASSERT_TRUE(WaitForAll().ok());

  server_.SupersedeLease();
  Append(1);

  const absl::Status status = session_->WaitApplied(last_, kPatience);
  EXPECT_EQ(ErrorReason(status), kLeaseSuperseded);
  EXPECT_EQ(session_->health(), status);
}

TEST_F(IngestSessionTest, ALogThatAnotherClientWroteEndsTheSessionForGood) {
  Start();
  Append(1);
  ASSERT_TRUE(WaitForAll().ok());
  server_.BreakLink();
  server_.Preload(1000);
  server_.MendLink();

  const absl::Status status = session_->WaitApplied(2, kPatience);

  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_THAT(std::string(status.message()), ::testing::HasSubstr("1000"));
}

TEST_F(IngestSessionTest, DurableEntriesAreForgotten) {
  server_.set_durable(true);
  Start();

  Append(10);

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(session_->statistics().durable_sequence, 10);
}

TEST_F(IngestSessionTest, EndsAtOnceWhateverTheLinkDoes) {
  IngestOptions options = QuickOptions();
  options.backoff = {.initial = absl::Hours(1), .maximum = absl::Hours(1)};
  server_.BreakLink();
  server_.MendLink();
  Start(options);
  server_.BreakLink();
  Append(5);

  session_.reset();  // would hang for an hour if waiting could not be interrupted
}

TEST_F(IngestSessionTest, ManyThreadsMayAppendAtOnce) {
  Start();
  constexpr int kThreads = 4;
  constexpr int kEach = 200;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([this] {
      for (int i = 0; i < kEach; ++i) session_->Append(i, {}, GasReading{});
    });
  }
  for (std::thread& thread : threads) thread.join();

  ASSERT_TRUE(session_->WaitApplied(kThreads * kEach, kPatience).ok());
  EXPECT_EQ(ReceivedNumbers(), Range(1, kThreads * kEach));
}

TEST_F(IngestSessionTest, WhoIsRemovedWhileItsStreamIsOpenStaysAway) {
  Start();
  Append(1);
  ASSERT_TRUE(WaitForAll().ok());
  ASSERT_TRUE(server_.RemoveRobot("m", "r", 0, /*force=*/true).ok());
  Append(1);
  const absl::Status status = WaitForAll();
  EXPECT_TRUE(absl::IsNotFound(status)) << status;
  EXPECT_TRUE(absl::IsNotFound(session_->health())) << session_->health();
  EXPECT_EQ(ReceivedNumbers(), Range(1, 1));
}

}  // namespace ingest_session_test
}  // namespace plumescout::client
