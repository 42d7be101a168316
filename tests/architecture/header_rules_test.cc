// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/header_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/str_join.h"

namespace plumescout {
namespace header_rules_test {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(HeaderRules, HeadersOfTheProjectIncludeWhatTheyName) {
  EXPECT_EQ(absl::StrJoin(CheckHeaders(ReadSourceTree()), "\n"), "");
}

TEST(HeaderRules, NamesThatNothingDeclaresAreFound) {
  EXPECT_THAT(CheckHeaders({ParseSource("core/a.h",
                                        "#include <vector>\n"
                                        "std::vector<std::string> F();  // std::map\n"
                                        "absl::Status my_std::map();\n")}),
              ElementsAre("core/a.h uses absl::Status and does not include absl/status/status.h",
                          "core/a.h uses std::string and does not include string"));
}

TEST(HeaderRules, WhatAHeaderOfOursIncludesCounts) {
  EXPECT_THAT(CheckHeaders({ParseSource("core/a.h", "#include \"core/b.h\"\nstd::map<int> a;\n"),
                            ParseSource("core/b.h", "#include \"core/c.h\"\n"),
                            ParseSource("core/c.h", "#include <map>\n#include \"core/b.h\"\n")}),
              IsEmpty());
}

TEST(HeaderRules, SourcesMayNameWhatTheyLikeButIncludeTheirHeaderFirst) {
  EXPECT_THAT(CheckHeaders({ParseSource("core/a.h", ""),
                            ParseSource("core/a.cc", "#include \"core/a.h\"\nstd::string a;\n"),
                            ParseSource("core/b.h", ""),
                            ParseSource("core/b.cc", "#include <map>\n#include \"core/b.h\"\n"),
                            ParseSource("core/c.cc", "#include <map>\n")}),
              ElementsAre("core/b.cc does not include its header first"));
}

}  // namespace header_rules_test
}  // namespace plumescout
