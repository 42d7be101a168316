// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace plumescout::server {
namespace log_test {

using ::testing::MatchesRegex;

TEST(LogTest, LineHasTimeLevelWordsAndFacts) {
  testing::internal::CaptureStderr();
  LogInfo("mission created", {{"mission", "hall"}, {"cells", "42"}});
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              MatchesRegex("[0-9-]+T[0-9:]+\\.[0-9]+Z INFO mission created mission=hall "
                           "cells=42\n"));
}

TEST(LogTest, ValueCannotForgeALine) {
  testing::internal::CaptureStderr();
  LogWarning("odd", {{"name", "a\n2026 INFO b"}});
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              MatchesRegex(".*Z WARNING odd name=\"a\\\\n2026 INFO b\"\n"));
}

}  // namespace log_test
}  // namespace plumescout::server
