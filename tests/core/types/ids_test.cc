// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/ids.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace plumescout {
namespace ids_test {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ValidateId, TakesLowerCaseLettersDigitsAndInnerHyphens) {
  for (const char* id : {"a", "a1", "robot-1", "a--b"}) {
    EXPECT_TRUE(ValidateId("robot", id).ok()) << id;
  }
  EXPECT_TRUE(ValidateId("robot", std::string(63, 'x')).ok());
}

TEST(ValidateId, RefusesEverythingElse) {
  for (const char* id : {"", "1a", "-a", "a-", "A", "a_b", "a b", "a/b", "\xC3\xA4"}) {
    EXPECT_EQ(ValidateId("robot", id).code(), absl::StatusCode::kInvalidArgument) << id;
  }
  EXPECT_FALSE(ValidateId("robot", std::string(64, 'x')).ok());
  EXPECT_FALSE(ValidateId("robot", std::string("a\0b", 3)).ok());
}

TEST(ValidateId, NamesTheFieldAndShowsTheIdHarmless) {
  const std::string message(ValidateId("mission", "a\nb").message());
  EXPECT_THAT(message, HasSubstr("mission"));
  EXPECT_THAT(message, HasSubstr("a\\nb"));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
}

TEST(ValidateId, ShowsNoMoreThanTheBeginningOfAHugeId) {
  EXPECT_LT(ValidateId("robot", std::string(1'000'000, 'x')).message().size(), 500U);
}

}  // namespace ids_test
}  // namespace plumescout
