// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/conduct_errors.h"

#include <gtest/gtest.h>

#include "core/types/error_reason.h"

namespace plumescout {
namespace conduct_errors_test {

TEST(ConductErrors, EachHasItsReasonAndCode) {
  const auto expect = [](const absl::Status& status, absl::StatusCode code,
                         absl::string_view reason) {
    EXPECT_EQ(status.code(), code) << status;
    EXPECT_EQ(ErrorReason(status), reason) << status;
  };
  expect(MissionNotFound("hall"), absl::StatusCode::kNotFound, "MISSION_NOT_FOUND");
  expect(MissionExists("hall"), absl::StatusCode::kAlreadyExists, "MISSION_EXISTS");
  expect(RobotNotFound("r1"), absl::StatusCode::kNotFound, "ROBOT_NOT_FOUND");
  expect(LeaseHeld("r1", 1), absl::StatusCode::kFailedPrecondition, "LEASE_HELD");
  expect(LeaseSuperseded("r1"), absl::StatusCode::kFailedPrecondition, "LEASE_SUPERSEDED");
  expect(StreamReplaced("r1"), absl::StatusCode::kAborted, "STREAM_REPLACED");
  expect(CreditExceeded(9, 8), absl::StatusCode::kResourceExhausted, "CREDIT_EXCEEDED");
}

TEST(ConductErrors, MessagesNameWhatTheyAreAbout) {
  EXPECT_EQ(MissionNotFound("hall").message(), "MISSION_NOT_FOUND: missions/hall");
  EXPECT_EQ(RobotNotFound("r1").message(), "ROBOT_NOT_FOUND: robot \"r1\"");
  EXPECT_EQ(CreditExceeded(9, 8).message(), "CREDIT_EXCEEDED: sequence 9 is beyond the credit, 8");
}

TEST(ConductErrors, WhatPassesSaysWhenToTryAgain) {
  EXPECT_EQ(RetryAfter_ns(LeaseHeld("r1", 3)), 3);
  EXPECT_TRUE(RetryAfter_ns(CreditExceeded(9, 8)).has_value());
  EXPECT_FALSE(RetryAfter_ns(LeaseSuperseded("r1")).has_value());
}

TEST(ConductErrorsTest, MissionsThatDoNotRunSaySo) {
  EXPECT_EQ(ErrorReason(MissionPaused("hall")), reason::kMissionPaused);
  EXPECT_EQ(ErrorReason(MissionFinished("hall")), reason::kMissionFinished);
  EXPECT_TRUE(absl::IsFailedPrecondition(MissionPaused("hall")));
  EXPECT_TRUE(absl::IsFailedPrecondition(MissionFinished("hall")));
}

}  // namespace conduct_errors_test
}  // namespace plumescout
