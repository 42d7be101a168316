// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/error_reason.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "proto/convert/field.h"
#include "proto/convert/status.h"

namespace plumescout::client {
namespace error_reason_test {

TEST(IsRetriable, HoldsForTroubleThatPassesOnly) {
  EXPECT_TRUE(IsRetriable(absl::UnavailableError("")));
  EXPECT_TRUE(IsRetriable(absl::DeadlineExceededError("")));
  EXPECT_TRUE(IsRetriable(absl::ResourceExhaustedError("")));
  EXPECT_FALSE(IsRetriable(absl::OkStatus()));
  EXPECT_FALSE(IsRetriable(absl::InvalidArgumentError("")));
  EXPECT_FALSE(IsRetriable(absl::NotFoundError("")));
  EXPECT_FALSE(IsRetriable(absl::FailedPreconditionError("")));
}

TEST(RetryDelayOf, IsTheServersWordWithinReason) {
  const absl::Status full = absl::UnavailableError("STORE_UNAVAILABLE: no room");
  EXPECT_EQ(RetryDelayOf(full), absl::ZeroDuration());
  EXPECT_EQ(RetryDelayOf(WithRetryDelay(full, absl::Milliseconds(1500))), absl::Milliseconds(1500));
  EXPECT_EQ(RetryDelayOf(WithRetryAfter(full, 2'000'000)), absl::Milliseconds(2));
  EXPECT_EQ(RetryDelayOf(WithRetryDelay(full, absl::Hours(5))), absl::Seconds(30));
  EXPECT_EQ(RetryDelayOf(WithRetryDelay(full, -absl::Seconds(1))), absl::ZeroDuration());
}

TEST(RolledBackTo, IsInTheErrorsMetadata) {
  const absl::Status error = absl::FailedPreconditionError("STORE_ROLLED_BACK: to 41");
  EXPECT_EQ(RolledBackTo(error), 0);
  EXPECT_EQ(RolledBackTo(WithReason(error, kStoreRolledBack, {{"applied_sequence", "41"}})), 41);
  EXPECT_EQ(RolledBackTo(WithReason(error, kStoreRolledBack, {{"applied_sequence", "-3"}})), 0);
  EXPECT_EQ(RolledBackTo(WithReason(error, kStoreRolledBack, {{"applied_sequence", "x"}})), 0);
}

TEST(RefusedFields, AreThoseThatTheServerNames) {
  EXPECT_TRUE(RefusedFields(absl::InvalidArgumentError("radius_m")).empty());
  EXPECT_EQ(RefusedFields(FieldError("options.seed", 3.0, "is taken")),
            std::vector<std::string>{"options.seed"});
}

}  // namespace error_reason_test
}  // namespace plumescout::client
