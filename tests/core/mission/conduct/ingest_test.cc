// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/ingest.h"

#include <gtest/gtest.h>

#include "core/types/error_reason.h"
#include "tests/support/ingest_batch.h"

namespace plumescout {
namespace ingest_test {

TEST(Ingest, CreditRunsAheadOfWhatIsApplied) {
  EXPECT_EQ(CreditSequence({.applied_sequence = 7, .revision = 30}, 5), 12);
}

TEST(Ingest, BatchMayReachItsCreditAndNoFurther) {
  EXPECT_TRUE(CheckCredit(support::GasBatch(1, 5), 5).ok());
  const absl::Status beyond = CheckCredit(support::GasBatch(1, 7), 5);
  EXPECT_EQ(ErrorReason(beyond), reason::kCreditExceeded);
  EXPECT_NE(beyond.message().find("sequence 6 "), absl::string_view::npos) << beyond;
}

}  // namespace ingest_test
}  // namespace plumescout
