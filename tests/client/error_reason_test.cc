// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/error_reason.h"

#include <gtest/gtest.h>

namespace plumescout::client {
namespace {

TEST(ErrorReason, IsTheUpperSnakeWordBeforeTheColon) {
  EXPECT_EQ(ErrorReason(absl::FailedPreconditionError("SEQUENCE_GAP: expected 7")), kSequenceGap);
  EXPECT_EQ(ErrorReason(absl::AbortedError("LEASE_HELD")), kLeaseHeld);
}

TEST(ErrorReason, IsEmptyForPlainMessages) {
  EXPECT_EQ(ErrorReason(absl::OkStatus()), "");
  EXPECT_EQ(ErrorReason(absl::UnknownError("")), "");
  EXPECT_EQ(ErrorReason(absl::UnknownError("mission: not found")), "");
  EXPECT_EQ(ErrorReason(absl::UnknownError("IO error: disk")), "");
  EXPECT_EQ(ErrorReason(absl::UnknownError("_X: no")), "");
}

TEST(IsRetriable, HoldsForTroubleThatPassesOnly) {
  EXPECT_TRUE(IsRetriable(absl::UnavailableError("")));
  EXPECT_TRUE(IsRetriable(absl::DeadlineExceededError("")));
  EXPECT_TRUE(IsRetriable(absl::ResourceExhaustedError("")));
  EXPECT_FALSE(IsRetriable(absl::OkStatus()));
  EXPECT_FALSE(IsRetriable(absl::InvalidArgumentError("")));
  EXPECT_FALSE(IsRetriable(absl::NotFoundError("")));
  EXPECT_FALSE(IsRetriable(absl::FailedPreconditionError("")));
}

}  // namespace
}  // namespace plumescout::client
