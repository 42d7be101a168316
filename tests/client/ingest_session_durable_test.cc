// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A session whose server, or which itself, keeps its data on disk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "client/ingest_session.h"
#include "tests/client/ingest_session_fixture.h"
#include "tests/support/temp_folder.h"

namespace plumescout::client {
namespace ingest_session_durable_test {

using ::testing::ElementsAre;

class IngestSessionDurableTest : public IngestSessionFixture {};

TEST_F(IngestSessionDurableTest, AServerThatRestartsWithItsDataServesTheSameLease) {
  server_.set_durable(true);
  Start();
  Append(100);
  ASSERT_TRUE(WaitForAll().ok());
  const std::int64_t lease = session_->session().lease_token;

  server_.Crash();
  Append(100);

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(ReceivedNumbers(), Range(1, 200));
  EXPECT_EQ(session_->session().lease_token, lease);
  EXPECT_EQ(session_->session().server_boot_id, "boot-2");
  EXPECT_EQ(session_->statistics().server_restarts, 1);
  EXPECT_EQ(server_.registrations().size(), 1U);
}

TEST_F(IngestSessionDurableTest, WhatWasAppliedButNotDurableIsToldAgain) {
  server_.set_durable(true, /*lag=*/30);
  Start();
  Append(100);
  ASSERT_TRUE(WaitForAll().ok());

  server_.Crash();
  Append(1);

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(ReceivedNumbers(), Range(1, 101));
  EXPECT_EQ(session_->statistics().rollbacks, 0);
}

TEST_F(IngestSessionDurableTest, AServerThatWasSetBackIsToldWhatItLacks) {
  server_.set_durable(true);
  Start();
  Append(100);
  ASSERT_TRUE(WaitForAll().ok());

  server_.SetBack(40);
  Append(1);

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(ReceivedNumbers(), Range(1, 101));
  EXPECT_EQ(session_->statistics().rollbacks, 1);
  EXPECT_EQ(session_->statistics().forgotten, 0);
  absl::MutexLock lock(&mutex_);
  EXPECT_THAT(rolled_back_, ElementsAre(std::pair<std::int64_t, std::int64_t>(40, 0)));
}

TEST_F(IngestSessionDurableTest, WhatIsForgottenIsDeclaredToAServerThatWasSetBack) {
  server_.set_durable(true);
  IngestOptions options = QuickOptions();
  options.log.max_durable_bytes = 0;
  Start(options);
  Append(100);
  ASSERT_TRUE(session_->WaitSafe(last_, kPatience).ok());

  server_.SetBack(40);
  ASSERT_TRUE(AwaitAtLeast(&IngestStatistics::rollbacks, 1));
  ASSERT_TRUE(WaitForAll().ok());
  Append(1);

  ASSERT_TRUE(WaitForAll().ok());
  const std::vector<Observation> received = server_.received();
  ASSERT_EQ(received.size(), 42U);
  EXPECT_EQ(received[40].payload, (decltype(Observation::payload)(SequenceGap{41, 100})));
  EXPECT_EQ(session_->statistics().forgotten, 60);
}

TEST_F(IngestSessionDurableTest, AServerThatWasSetBackBeforeTheLeaseGivesAnother) {
  server_.set_durable(true);
  Start();
  Append(100);
  ASSERT_TRUE(WaitForAll().ok());

  server_.BreakLink();
  server_.SetBack(40, /*forget_lease=*/true);
  server_.MendLink();
  Append(1);

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(ReceivedNumbers(), Range(1, 101));
  EXPECT_EQ(server_.registrations().size(), 2U);
  EXPECT_FALSE(server_.registrations().back().take_over);
}

TEST_F(IngestSessionDurableTest, ObservationsFollowThoseOfAnotherLog) {
  participation_.log_epoch = 8;
  Start();
  Append(10);
  ASSERT_TRUE(WaitForAll().ok());

  server_.BreakLink();
  Append(5);
  server_.Intrude(/*log_epoch=*/9, /*observations=*/20);
  server_.MendLink();

  ASSERT_TRUE(session_->WaitApplied(35, kPatience).ok());
  const std::vector<Observation> received = server_.received();
  ASSERT_EQ(received.size(), 35U);
  EXPECT_EQ(received[30].sample_time_ns, 10);  // the first of the five
  EXPECT_EQ(session_->statistics().last_sequence, 35);
  EXPECT_EQ(session_->health(), absl::OkStatus());
}

TEST_F(IngestSessionDurableTest, AFreshLogSwallowsNoNumbersWhateverTheServerSays) {
  server_.Preload(41);  // of a log that nobody named
  participation_.log_epoch = 8;
  Start();
  Append(2);

  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_EQ(ReceivedNumbers(), Range(42, 43));
}

TEST_F(IngestSessionDurableTest, SafeIsWhatTheServerHasOnDisk) {
  server_.set_durable(true, /*lag=*/3);
  Start();
  Append(10);
  ASSERT_TRUE(WaitForAll().ok());
  EXPECT_TRUE(session_->WaitSafe(7, kPatience).ok());

  const absl::Status status = session_->WaitSafe(8, absl::Milliseconds(10));

  EXPECT_TRUE(absl::IsDeadlineExceeded(status)) << status;
  EXPECT_EQ(session_->statistics().durable_sequence, 7);
}

TEST_F(IngestSessionDurableTest, WithoutADiskNothingIsWaitedFor) {
  Start();
  Append(10);
  EXPECT_TRUE(session_->WaitSafe(last_, kPatience).ok());
}

// The process of the robot ends with observations on their way, and the server loses what it had
// not on disk.
TEST_F(IngestSessionDurableTest, NothingIsLostWhenRobotAndServerEndTimeAndAgain) {
  const TempFolder folder;
  server_.set_durable(true, /*lag=*/7);
  IngestOptions options = QuickOptions();
  options.store.folder = folder.File("log");
  options.store.segment_bytes = 3000;
  options.log.max_durable_bytes = 2000;
  for (int life = 0; life < 12; ++life) {
    StartWithDisk(options);
    Append(25);
    if (life % 3 == 0) {
      ASSERT_TRUE(WaitForAll().ok());
    }
    if (life % 2 == 0) server_.Crash();
    Append(5);
    if (life % 4 == 1) {
      ASSERT_TRUE(WaitForAll().ok());
    }
    session_.reset();
    if (life % 5 == 2) server_.Crash();
  }
  StartWithDisk(options);
  ASSERT_TRUE(session_->WaitApplied(12 * 30, kPatience).ok());

  EXPECT_EQ(ReceivedNumbers(), Range(1, 12 * 30));
  std::vector<std::int64_t> times;
  for (const Observation& observation : server_.received()) {
    times.push_back(observation.sample_time_ns);
  }
  EXPECT_EQ(times, appended_times_);
  for (const auto& registration : server_.registrations()) EXPECT_EQ(registration.log_epoch, 100);
}

TEST_F(IngestSessionDurableTest, ALogOnDiskGoesOnAfterAnotherOne) {
  const TempFolder folder;
  IngestOptions options = QuickOptions();
  options.store.folder = folder.File("log");
  StartWithDisk(options);
  Append(10);
  ASSERT_TRUE(WaitForAll().ok());
  server_.BreakLink();
  Append(5);
  session_.reset();
  server_.Intrude(/*log_epoch=*/9, /*observations=*/20);
  server_.MendLink();

  StartWithDisk(options);
  ASSERT_TRUE(session_->WaitApplied(35, kPatience).ok());
  session_.reset();
  StartWithDisk(options);
  Append(1);

  ASSERT_TRUE(session_->WaitApplied(36, kPatience).ok());
  EXPECT_EQ(last_, 36);
  EXPECT_EQ(server_.received().size(), 36U);
  EXPECT_EQ(server_.received()[30].sample_time_ns, 10);
}

}  // namespace ingest_session_durable_test
}  // namespace plumescout::client
