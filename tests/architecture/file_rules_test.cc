// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/file_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "absl/strings/str_join.h"
namespace plumescout {
namespace file_rules_test {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr char kLicence[] =
    "// SPDX-FileCopyrightText: PlumeScout contributors\n// SPDX-License-Identifier: Apache-2.0\n";

TEST(FileRules, EverySourceOfTheProjectHasItsTest) {
  EXPECT_EQ(absl::StrJoin(CheckMirror(ReadSourceTree()), "\n"), "");
}

TEST(FileRules, EveryFileOfTheProjectHasItsFrame) {
  EXPECT_EQ(absl::StrJoin(CheckFrames(ReadSourceTree()), "\n"), "");
}

TEST(FileRules, SourcesWithoutTestAreFound) {
  const std::vector<SourceFile> files = {ParseSource("core/gas/tested.cc", ""),
                                         ParseSource("tests/core/gas/tested_test.cc", ""),
                                         ParseSource("core/gas/slow.cc", ""),
                                         ParseSource("tests/core/gas/slow_slow_test.cc", ""),
                                         ParseSource("core/gas/untested.cc", ""),
                                         ParseSource("tests/core/plan/untested_test.cc", ""),
                                         ParseSource("core/gas/only_header.h", ""),
                                         ParseSource("server/main.cc", ""),
                                         ParseSource("client/examples/cpp/toy.cc", ""),
                                         ParseSource("lab/bench/gas_bench.cc", "")};
  EXPECT_THAT(CheckMirror(files), ElementsAre("core/gas/untested.cc has no test of its name"));
}

TEST(FileRules, FilesWithoutTheirFrameAreFound) {
  const std::string licence = kLicence;
  EXPECT_THAT(CheckFrames({ParseSource("a.cc", "int a;\n")}),
              ElementsAre("a.cc does not begin with the licence"));
  EXPECT_THAT(CheckFrames({ParseSource("a.h", licence + "int a;\n")}),
              ElementsAre("a.h lacks #pragma once"));
  EXPECT_THAT(CheckFrames({ParseSource("a.h", licence + "#pragma once\nusing namespace std;\n")}),
              ElementsAre("a.h has a using directive"));
  EXPECT_THAT(CheckFrames({ParseSource("a.h", licence + "#pragma once\n")}), IsEmpty());
}

}  // namespace file_rules_test
}  // namespace plumescout
