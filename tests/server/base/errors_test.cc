// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "proto/convert/field.h"
#include "proto/convert/status.h"

namespace plumescout::server {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

TEST(ErrorsTest, TypedErrorsCarryTheirReason) {
  EXPECT_EQ(Reason(WithErrorInfo(MissionNotFound("hall"))), "MISSION_NOT_FOUND");
  EXPECT_EQ(Reason(WithErrorInfo(RobotNotFound("r1"))), "ROBOT_NOT_FOUND");
  EXPECT_EQ(Reason(WithErrorInfo(LeaseHeld("r1", absl::Seconds(1)))), "LEASE_HELD");
  EXPECT_EQ(Reason(WithErrorInfo(LeaseSuperseded("r1"))), "LEASE_SUPERSEDED");
  EXPECT_EQ(Reason(WithErrorInfo(StreamReplaced("r1"))), "STREAM_REPLACED");
  EXPECT_EQ(Reason(WithErrorInfo(CreditExceeded(9, 8))), "CREDIT_EXCEEDED");
  EXPECT_EQ(Reason(WithErrorInfo(Overloaded("full"))), "OVERLOADED");
  EXPECT_EQ(Reason(WithErrorInfo(LimitReached("full"))), "LIMIT_REACHED");
  EXPECT_EQ(Reason(WithErrorInfo(Draining())), "DRAINING");
}

TEST(ErrorsTest, WhatPassesSaysWhenToRetryAndWhatDoesNotDoesNot) {
  EXPECT_TRUE(RetryDelay(Overloaded("full")).has_value());
  EXPECT_TRUE(RetryDelay(Draining()).has_value());
  EXPECT_EQ(RetryDelay(LeaseHeld("r1", absl::Seconds(3))), absl::Seconds(3));
  EXPECT_FALSE(RetryDelay(LimitReached("full")).has_value());
  EXPECT_FALSE(RetryDelay(LeaseSuperseded("r1")).has_value());
}

TEST(ErrorsTest, HoleInALogTellsTheNumberExpected) {
  const absl::Status status =
      WithErrorInfo(absl::FailedPreconditionError("SEQUENCE_GAP: expected 7, got 9"));
  EXPECT_EQ(Reason(status), "SEQUENCE_GAP");
  EXPECT_THAT(ReasonMetadata(status), ElementsAre(Pair("expected", "7")));
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

}  // namespace
}  // namespace plumescout::server
