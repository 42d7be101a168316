// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/status_macros.h"

#include <gtest/gtest.h>

#include <memory>

namespace plumescout {
namespace status_macros_test {

absl::Status ReturnsEarly(const absl::Status& status, bool& went_on) {
  PLUMESCOUT_RETURN_IF_ERROR(status);
  went_on = true;
  return absl::OkStatus();
}

absl::StatusOr<int> AddsOne(absl::StatusOr<int> number) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const int value, std::move(number));
  return value + 1;
}

absl::StatusOr<int> Dereferences(absl::StatusOr<std::unique_ptr<int>> pointer) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::unique_ptr<int> owned, std::move(pointer));
  return *owned;
}

TEST(ReturnIfError, ReturnsTheErrorAndGoesOnOtherwise) {
  bool went_on = false;
  EXPECT_EQ(ReturnsEarly(absl::NotFoundError("no"), went_on), absl::NotFoundError("no"));
  EXPECT_FALSE(went_on);
  EXPECT_TRUE(ReturnsEarly(absl::OkStatus(), went_on).ok());
  EXPECT_TRUE(went_on);
}

TEST(AssignOrReturn, AssignsTheValueOrReturnsTheError) {
  EXPECT_EQ(*AddsOne(41), 42);
  EXPECT_EQ(AddsOne(absl::InternalError("no")).status(), absl::InternalError("no"));
}

TEST(AssignOrReturn, MovesWhatCannotBeCopied) {
  EXPECT_EQ(*Dereferences(std::make_unique<int>(5)), 5);
}

}  // namespace status_macros_test
}  // namespace plumescout
