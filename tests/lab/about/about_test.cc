// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/about/about.h"

#include <map>
#include <string>

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace plumescout::lab {
namespace about_test {

TEST(AboutThisRun, NamesMachineLoadBuildSeedAndVersion) {
  const auto about = AboutThisRun(42);
  const std::map<std::string, std::string> entries(about.begin(), about.end());
  EXPECT_THAT(entries, testing::SizeIs(5));
  EXPECT_EQ(entries.at("seed"), "42");
  for (const char* name : {"machine", "load", "build_type", "version"}) {
    EXPECT_THAT(entries.at(name), testing::Not(testing::IsEmpty())) << name;
  }
}

}  // namespace about_test
}  // namespace plumescout::lab
