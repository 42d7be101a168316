// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ingest_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "absl/time/clock.h"
#include "client/error_reason.h"
#include "client/join.h"
#include "tests/client/fake_planner_client.h"

namespace plumescout::client {
namespace ingest_session_test {

using ::testing::ElementsAre;

// Long enough for a loaded machine; never waited out by a passing test.
constexpr absl::Duration kPatience = absl::Seconds(20);

IngestOptions QuickOptions() {
  IngestOptions options;
  options.backoff = {.initial = absl::Milliseconds(1), .maximum = absl::Milliseconds(5)};
  options.read_slice = absl::Milliseconds(1);
  options.idle_check = absl::Milliseconds(2);
  return options;
}

class IngestSessionTest : public ::testing::Test {
 protected:
  IngestSession& Start(const IngestOptions& options = QuickOptions()) {
    IngestCallbacks callbacks;
    callbacks.rejoin = [this] { return Join(server_, participation_); };
    callbacks.on_rejected = [this](const ObservationRejected& rejected) {
      absl::MutexLock lock(&mutex_);
      rejected_.push_back(rejected.sequence);
    };
    session_ = std::make_unique<IngestSession>(server_, *Join(server_, participation_),
                                               std::move(callbacks), options);
    return *session_;
  }

  void Append(int count) {
    for (int i = 0; i < count; ++i) last_ = session_->Append(i, {}, GasReading{});
  }
  absl::Status WaitForAll() { return session_->WaitApplied(last_, kPatience); }

  std::vector<std::int64_t> ReceivedNumbers() const {
    std::vector<std::int64_t> numbers;
    for (const Observation& observation : server_.received()) {
      numbers.push_back(observation.sequence);
    }
    return numbers;
  }
  static std::vector<std::int64_t> Range(std::int64_t first, std::int64_t last) {
    std::vector<std::int64_t> numbers;
    for (std::int64_t n = first; n <= last; ++n) numbers.push_back(n);
    return numbers;
  }

  FakePlannerClient server_;
  Participation participation_{.mission = "m", .robot = "r", .create = MissionOptions{}};
  std::int64_t last_ = 0;
  absl::Mutex mutex_;
  std::vector<std::int64_t> rejected_;
  std::unique_ptr<IngestSession> session_;
};

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

  while (session_->statistics().server_restarts == 0) absl::SleepFor(absl::Milliseconds(1));
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
  while (session_->statistics().server_restarts == 0) absl::SleepFor(absl::Milliseconds(1));

  ASSERT_TRUE(WaitForAll().ok());
  const std::vector<Observation> received = server_.received();
  ASSERT_FALSE(received.empty());
  EXPECT_EQ(received.front().payload,
            (std::variant<Scan, GasReading, SequenceGap>(SequenceGap{1, 10})));
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

}  // namespace ingest_session_test
}  // namespace plumescout::client
