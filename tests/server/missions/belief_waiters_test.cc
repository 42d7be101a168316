// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/belief_waiters.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "tests/server/host_parts.h"

namespace plumescout::server {
namespace {

constexpr std::int64_t kLease = 7;

class BeliefWaitersTest : public testing::Test {
 protected:
  BeliefWaitersTest() { EXPECT_TRUE(writer_.Register({"r1", 0.2, kLease}).ok()); }

  void Wait(BeliefRequest request) {
    waiters_.Add(std::move(request), [this](absl::StatusOr<std::shared_ptr<const Belief>> belief) {
      ++answers_;
      answer_ = belief.status();
    });
  }

  MissionWriter writer_{std::make_unique<Mission>(MissionOptions{}), nullptr};
  BeliefWaiters waiters_{2};
  SteadyTime now_;
  int answers_ = 0;
  std::optional<absl::Status> answer_;
};

TEST_F(BeliefWaitersTest, WaitsUntilTheLogIsThere) {
  Wait({.robot = "r1", .min_applied_sequence = 3});
  writer_.Ingest("r1", kLease, GasBatch(1, 2));
  waiters_.Serve(writer_, now_);
  EXPECT_EQ(answers_, 0);
  writer_.Ingest("r1", kLease, GasBatch(3, 3));
  waiters_.Serve(writer_, now_);
  waiters_.Serve(writer_, now_);
  EXPECT_EQ(answers_, 1);
  EXPECT_TRUE(answer_->ok());
}

TEST_F(BeliefWaitersTest, GivesUpAtTheDeadline) {
  const SteadyTime deadline = now_ + std::chrono::seconds(5);
  Wait({.robot = "r1", .min_applied_sequence = 3, .deadline = deadline});
  EXPECT_EQ(waiters_.next_deadline(), deadline);
  waiters_.Serve(writer_, deadline - std::chrono::nanoseconds(1));
  EXPECT_EQ(answers_, 0);
  waiters_.Serve(writer_, deadline);
  EXPECT_TRUE(absl::IsDeadlineExceeded(*answer_));
  EXPECT_EQ(waiters_.next_deadline(), SteadyTime::max());
}

TEST_F(BeliefWaitersTest, DropsWhoIsNotThereAnyMore) {
  bool gone = false;
  Wait({.robot = "r1", .min_applied_sequence = 3, .abandoned = [&] { return gone; }});
  waiters_.Serve(writer_, now_);
  EXPECT_EQ(answers_, 0);
  gone = true;
  waiters_.Serve(writer_, now_);
  EXPECT_TRUE(absl::IsCancelled(*answer_));
}

TEST_F(BeliefWaitersTest, UnknownRobotIsNotWaitedFor) {
  Wait({.robot = "r9"});
  waiters_.Serve(writer_, now_);
  EXPECT_TRUE(absl::IsNotFound(*answer_));
}

TEST_F(BeliefWaitersTest, ReaderOfThePosteriorAsItIsChangesNothing) {
  writer_.Ingest("r1", kLease, GasBatch(1, 1));
  const std::int64_t revision = writer_.mission().revision();
  BeliefRequest any;
  any.fresh_posterior = false;
  Wait(any);
  waiters_.Serve(writer_, now_);
  EXPECT_TRUE(answer_->ok());
  EXPECT_EQ(writer_.mission().revision(), revision);
}

TEST_F(BeliefWaitersTest, TooManyAreRefusedAtOnce) {
  for (int i = 0; i < 2; ++i) Wait({.robot = "r1", .min_applied_sequence = 3});
  EXPECT_EQ(answers_, 0);
  Wait({.robot = "r1", .min_applied_sequence = 3});
  EXPECT_EQ(answers_, 1);
  EXPECT_TRUE(absl::IsResourceExhausted(*answer_));
}

TEST_F(BeliefWaitersTest, FailAllAnswersEveryone) {
  for (int i = 0; i < 2; ++i) Wait({.robot = "r1", .min_applied_sequence = 3});
  waiters_.FailAll(absl::UnavailableError("over"));
  EXPECT_EQ(answers_, 2);
  EXPECT_TRUE(absl::IsUnavailable(*answer_));
}

}  // namespace
}  // namespace plumescout::server
