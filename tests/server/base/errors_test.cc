// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mission/conduct/conduct_errors.h"
#include "proto/convert/field.h"
#include "proto/convert/status.h"

namespace plumescout::server {
namespace errors_test {

using ::testing::ElementsAre;
using ::testing::Pair;

TEST(ErrorsTest, TypedErrorsCarryTheirReason) {
  EXPECT_EQ(Reason(WithErrorInfo(MissionNotFound("hall"))), "MISSION_NOT_FOUND");
  EXPECT_EQ(Reason(WithErrorInfo(RobotNotFound("r1"))), "ROBOT_NOT_FOUND");
  EXPECT_EQ(Reason(WithErrorInfo(LeaseHeld("r1", 1))), "LEASE_HELD");
  EXPECT_EQ(Reason(WithErrorInfo(LeaseSuperseded("r1"))), "LEASE_SUPERSEDED");
  EXPECT_EQ(Reason(WithErrorInfo(StreamReplaced("r1"))), "STREAM_REPLACED");
  EXPECT_EQ(Reason(WithErrorInfo(CreditExceeded(9, 8))), "CREDIT_EXCEEDED");
  EXPECT_EQ(Reason(WithErrorInfo(Overloaded("full"))), "OVERLOADED");
  EXPECT_EQ(Reason(WithErrorInfo(LimitReached("full"))), "LIMIT_REACHED");
  EXPECT_EQ(Reason(WithErrorInfo(Draining())), "DRAINING");
}

TEST(ErrorsTest, WhatPassesSaysWhenToRetryAndWhatDoesNotDoesNot) {
  const auto delay = [](const absl::Status& status) { return RetryDelay(WithErrorInfo(status)); };
  EXPECT_EQ(delay(Overloaded("full")), absl::Milliseconds(250));
  EXPECT_EQ(delay(Draining()), absl::Seconds(1));
  EXPECT_EQ(delay(LeaseHeld("r1", 3'000'000'001)), absl::Seconds(3) + absl::Nanoseconds(1));
  EXPECT_EQ(delay(CreditExceeded(9, 8)), absl::Milliseconds(250));
  EXPECT_FALSE(delay(LimitReached("full")).has_value());
  EXPECT_FALSE(delay(LeaseSuperseded("r1")).has_value());
}

TEST(ErrorsTest, NothingButDetailsOfGoogleRpcGoesOverTheWire) {
  EXPECT_EQ(ToProto(WithErrorInfo(LeaseHeld("r1", 1))).details_size(), 2);
  const absl::Status reasoned = WithReason(LeaseHeld("r1", 1), "MINE");
  EXPECT_EQ(ToProto(WithErrorInfo(reasoned)).details_size(), 2);
}

TEST(ErrorsTest, WhichMissionIsAwaitedStaysHere) {
  const absl::Status awaited = WithAwaitedMission(Recovering("hall"), "acme/hall");
  EXPECT_EQ(AwaitedMission(awaited), "acme/hall");
  EXPECT_EQ(AwaitedMission(Recovering("hall")), "");
  EXPECT_EQ(AwaitedMission(WithAwaitedMission(MissionNotFound("hall"), "hall")), "");
  const absl::Status told = WithErrorInfo(awaited);
  EXPECT_EQ(AwaitedMission(told), "");
  EXPECT_EQ(Reason(told), "RECOVERING");
  EXPECT_EQ(RetryDelay(told), absl::Milliseconds(500));
}

TEST(ErrorsTest, HoleInALogTellsTheNumberExpected) {
  const absl::Status status =
      WithErrorInfo(absl::FailedPreconditionError("SEQUENCE_GAP: expected 7, got 9"));
  EXPECT_EQ(Reason(status), "SEQUENCE_GAP");
  EXPECT_THAT(ReasonMetadata(status), ElementsAre(Pair("expected", "7")));
}

TEST(ErrorsTest, AServerThatWasSetBackTellsWhereItStands) {
  const absl::Status status = WithErrorInfo(StoreRolledBack(12, 40));
  EXPECT_TRUE(absl::IsFailedPrecondition(status));
  EXPECT_EQ(Reason(status), "STORE_ROLLED_BACK");
  EXPECT_THAT(ReasonMetadata(status), ElementsAre(Pair("applied_sequence", "12")));
}

TEST(ErrorsTest, WhatIsOverSoonSaysWhen) {
  for (const absl::Status& status :
       {WithErrorInfo(StoreTakesNothing("STORE_UNAVAILABLE: missions.db: disk full")),
        WithErrorInfo(StoreTakesNothing("missions.db: disk full"))}) {
    EXPECT_TRUE(absl::IsUnavailable(status));
    EXPECT_EQ(Reason(status), "STORE_UNAVAILABLE");
    EXPECT_EQ(status.message(), "STORE_UNAVAILABLE: missions.db: disk full");
    EXPECT_TRUE(RetryDelay(status).has_value());
  }
  EXPECT_EQ(Reason(WithErrorInfo(Recovering("hall"))), "RECOVERING");
  EXPECT_TRUE(RetryDelay(WithErrorInfo(Recovering("hall"))).has_value());
  const absl::Status damaged = WithErrorInfo(MissionDamaged("hall", "event 3"));
  EXPECT_TRUE(absl::IsDataLoss(damaged));
  EXPECT_EQ(Reason(damaged), "STORE_DAMAGED");
  EXPECT_FALSE(RetryDelay(damaged).has_value());
}

TEST(ErrorsTest, OtherErrorsAreNamedAfterTheirCode) {
  EXPECT_EQ(Reason(WithErrorInfo(absl::InternalError("Oops: it broke"))), "INTERNAL");
  EXPECT_EQ(Reason(WithErrorInfo(FieldError("pose", "must be set"))), "INVALID_ARGUMENT");
}

TEST(ErrorsTest, ReasonThatIsThereStays) {
  const absl::Status status = WithReason(absl::AbortedError("A: b"), "MINE");
  EXPECT_EQ(Reason(WithErrorInfo(status)), "MINE");
  EXPECT_TRUE(WithErrorInfo(absl::OkStatus()).ok());
}

TEST(ErrorsTest, WhoAsksTooMuchIsToldWhenToAskAgain) {
  const absl::Status refused = WithErrorInfo(RateExceeded("too many plans", absl::Seconds(2)));
  EXPECT_TRUE(absl::IsResourceExhausted(refused));
  EXPECT_EQ(Reason(refused), "RATE_EXCEEDED");
  EXPECT_EQ(RetryDelay(refused), absl::Seconds(2));
}

}  // namespace errors_test
}  // namespace plumescout::server
