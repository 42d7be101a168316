// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/error_reason.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace error_reason_test {

TEST(ErrorReason, IsTheUpperSnakeWordBeforeTheColon) {
  EXPECT_EQ(ErrorReason(absl::FailedPreconditionError("SEQUENCE_GAP: expected 7")),
            reason::kSequenceGap);
  EXPECT_EQ(ErrorReason(absl::AbortedError("LEASE_HELD")), reason::kLeaseHeld);
}

TEST(ErrorReason, IsEmptyForPlainMessages) {
  EXPECT_EQ(ErrorReason(absl::OkStatus()), "");
  EXPECT_EQ(ErrorReason(absl::UnknownError("")), "");
  EXPECT_EQ(ErrorReason(absl::UnknownError("mission: not found")), "");
  EXPECT_EQ(ErrorReason(absl::UnknownError("IO error: disk")), "");
  EXPECT_EQ(ErrorReason(absl::UnknownError("_X: no")), "");
}

TEST(TypedError, BeginsWithItsReason) {
  const absl::Status status =
      TypedError(absl::StatusCode::kAborted, reason::kStreamReplaced, "by a newer one");
  EXPECT_EQ(status, absl::AbortedError("STREAM_REPLACED: by a newer one"));
  EXPECT_EQ(ErrorReason(status), reason::kStreamReplaced);
}

TEST(RetryAfter, IsCarriedAlongAndTakenOff) {
  const absl::Status plain = absl::UnavailableError("DRAINING: soon");
  const absl::Status status = WithRetryAfter(plain, 1'500'000'000);
  EXPECT_EQ(RetryAfter_ns(status), 1'500'000'000);
  EXPECT_EQ(status.message(), plain.message());
  EXPECT_FALSE(RetryAfter_ns(plain).has_value());
  EXPECT_EQ(WithoutRetryAfter(status), plain);
}

}  // namespace error_reason_test
}  // namespace plumescout
