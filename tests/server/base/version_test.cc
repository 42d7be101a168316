// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/version.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumescout::server {
namespace version_test {

TEST(VersionTest, ItHasThreeNumbers) {
  EXPECT_THAT(kVersion, testing::MatchesRegex("[0-9]+[.][0-9]+[.][0-9]+"));
}

}  // namespace version_test
}  // namespace plumescout::server
