// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/paging.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "proto/convert/status.h"

namespace plumescout::server {
namespace paging_test {

// The field that a refusal is about.
std::string Blamed(const absl::Status& refused) {
  const std::vector<FieldViolation> violations = FieldViolations(refused);
  return absl::IsInvalidArgument(refused) && violations.size() == 1 ? violations[0].field : "";
}

TEST(PagingTest, SizesHaveADefaultAndABound) {
  EXPECT_EQ(ReadPage(0, "")->size, 100);
  EXPECT_EQ(ReadPage(7, "")->size, 7);
  EXPECT_EQ(ReadPage(100'000, "")->size, 1000);
  EXPECT_EQ(Blamed(ReadPage(-1, "").status()), "page_size");
}

TEST(PagingTest, ATokenSaysWhereToGoOn) {
  EXPECT_EQ(ReadPage(1, "")->after, "");
  EXPECT_EQ(ReadPage(1, PageTokenAfter("hall"))->after, "hall");
  EXPECT_EQ(Blamed(ReadPage(1, "hall").status()), "page_token");
  EXPECT_EQ(Blamed(ReadPage(1, "!").status()), "page_token");
}

}  // namespace paging_test
}  // namespace plumescout::server
