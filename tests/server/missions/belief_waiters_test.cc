// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/belief_waiters.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "core/types/error_reason.h"
#include "tests/server/host_parts.h"

namespace plumescout::server {
namespace belief_waiters_test {

constexpr std::int64_t kLease = 7;

class BeliefWaitersTest : public testing::Test {
 protected:
  BeliefWaitersTest() { EXPECT_TRUE(conduct_.Register(RobotRegistered{"r1", 0.2, kLease}).ok()); }

  void Wait(BeliefRequest request) {
    waiters_.Add(
        std::move(request),
        [this](const absl::StatusOr<std::shared_ptr<const Belief>>& belief) {
          ++answers_;
          answer_ = belief.status();
        },
        conduct_, now_);
  }

  MissionConduct conduct_{std::make_unique<Mission>(MissionOptions{})};
  BeliefWaiters waiters_{2};
  SteadyTime now_;
  int answers_ = 0;
  std::optional<absl::Status> answer_;
};

TEST_F(BeliefWaitersTest, WaitsUntilTheLogIsThere) {
  Wait({.wish = {.robot = "r1", .min_applied_sequence = 3}});
  conduct_.Ingest("r1", kLease, GasBatch(1, 2));
  waiters_.Serve(conduct_, now_);
  EXPECT_EQ(answers_, 0);
  conduct_.Ingest("r1", kLease, GasBatch(3, 3));
  waiters_.Serve(conduct_, now_);
  waiters_.Serve(conduct_, now_);
  EXPECT_EQ(answers_, 1);
  EXPECT_TRUE(answer_->ok());
}

TEST_F(BeliefWaitersTest, GivesUpAtTheDeadline) {
  const SteadyTime deadline = now_ + std::chrono::seconds(5);
  Wait({.wish = {.robot = "r1", .min_applied_sequence = 3}, .deadline = deadline});
  EXPECT_EQ(waiters_.next_deadline(), deadline);
  waiters_.Serve(conduct_, deadline - std::chrono::nanoseconds(1));
  EXPECT_EQ(answers_, 0);
  waiters_.Serve(conduct_, deadline);
  EXPECT_TRUE(absl::IsDeadlineExceeded(*answer_));
  EXPECT_EQ(waiters_.next_deadline(), SteadyTime::max());
}

TEST_F(BeliefWaitersTest, DropsWhoIsNotThereAnyMore) {
  bool gone = false;
  Wait({.wish = {.robot = "r1", .min_applied_sequence = 3}, .abandoned = [&] { return gone; }});
  waiters_.Serve(conduct_, now_);
  EXPECT_EQ(answers_, 0);
  gone = true;
  waiters_.Serve(conduct_, now_);
  EXPECT_TRUE(absl::IsCancelled(*answer_));
}

TEST_F(BeliefWaitersTest, UnknownRobotIsNotWaitedFor) {
  Wait({.wish = {.robot = "r9"}});
  waiters_.Serve(conduct_, now_);
  EXPECT_TRUE(absl::IsNotFound(*answer_));
}

TEST_F(BeliefWaitersTest, WhoLosesItsLeaseMeanwhileIsToldAtOnce) {
  Wait({.wish = {.robot = "r1", .min_applied_sequence = 3, .lease_token = kLease}});
  waiters_.Serve(conduct_, now_);
  EXPECT_EQ(answers_, 0);
  ASSERT_TRUE(conduct_.Register(RobotRegistered{"r1", 0.2, kLease + 1}).ok());
  waiters_.Serve(conduct_, now_);
  EXPECT_EQ(ErrorReason(*answer_), reason::kLeaseSuperseded);
}

TEST_F(BeliefWaitersTest, TooManyAreRefusedAtOnce) {
  for (int i = 0; i < 2; ++i) Wait({.wish = {.robot = "r1", .min_applied_sequence = 3}});
  EXPECT_EQ(answers_, 0);
  Wait({.wish = {.robot = "r1", .min_applied_sequence = 3}});
  EXPECT_EQ(answers_, 1);
  EXPECT_TRUE(absl::IsResourceExhausted(*answer_));
}

TEST_F(BeliefWaitersTest, WhoIsGoneTakesNobodysPlace) {
  bool gone = false;
  const StopFn abandoned = [&] { return gone; };
  for (int i = 0; i < 2; ++i) {
    Wait({.wish = {.robot = "r1", .min_applied_sequence = 3}, .abandoned = abandoned});
  }
  gone = true;
  Wait({.wish = {.robot = "r1", .min_applied_sequence = 3}});
  EXPECT_EQ(answers_, 2);
  EXPECT_TRUE(absl::IsCancelled(*answer_));
  EXPECT_EQ(waiters_.size(), 1);
}

TEST_F(BeliefWaitersTest, WhoseTimeIsUpTakesNobodysPlace) {
  for (int i = 0; i < 2; ++i) {
    Wait({.wish = {.robot = "r1", .min_applied_sequence = 3},
          .deadline = now_ + std::chrono::seconds(1)});
  }
  now_ += std::chrono::seconds(1);
  Wait({.wish = {.robot = "r1", .min_applied_sequence = 3}});
  EXPECT_EQ(answers_, 2);
  EXPECT_TRUE(absl::IsDeadlineExceeded(*answer_));
  EXPECT_EQ(waiters_.size(), 1);
}

TEST_F(BeliefWaitersTest, AbandonedOnesAreDroppedWithoutTheMission) {
  bool gone = false;
  Wait({.wish = {.robot = "r1", .min_applied_sequence = 3}, .abandoned = [&] { return gone; }});
  Wait({.wish = {.robot = "r1", .min_applied_sequence = 3}});
  waiters_.DropAbandoned();
  EXPECT_EQ(answers_, 0);
  gone = true;
  waiters_.DropAbandoned();
  EXPECT_EQ(answers_, 1);
  EXPECT_TRUE(absl::IsCancelled(*answer_));
  EXPECT_EQ(waiters_.size(), 1);
}

TEST_F(BeliefWaitersTest, CloseAnswersEveryoneAndThoseWhoComeLater) {
  Wait({.wish = {.robot = "r1", .min_applied_sequence = 3}});
  waiters_.Close(absl::UnavailableError("over"));
  EXPECT_EQ(answers_, 1);
  EXPECT_TRUE(absl::IsUnavailable(*answer_));
  waiters_.Close(absl::NotFoundError("over again"));
  Wait({.wish = {.robot = "r1"}});
  EXPECT_EQ(answers_, 2);
  EXPECT_TRUE(absl::IsUnavailable(*answer_));
}

TEST_F(BeliefWaitersTest, WhoIsFailedWhileOthersAreServedHearsOnce) {
  waiters_.Add(
      {.wish = {.robot = "r1"}},
      [this](const absl::StatusOr<std::shared_ptr<const Belief>>&) {
        waiters_.Close(absl::UnavailableError("over"));
      },
      conduct_, now_);
  Wait({.wish = {.robot = "r1"}});
  waiters_.Serve(conduct_, now_);
  EXPECT_EQ(answers_, 1);
  EXPECT_TRUE(absl::IsUnavailable(*answer_));
}

}  // namespace belief_waiters_test
}  // namespace plumescout::server
