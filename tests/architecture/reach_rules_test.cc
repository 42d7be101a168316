// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/reach_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/str_join.h"

namespace plumescout {
namespace reach_rules_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ReachRules, TheProjectKeepsTheLaboratoryApart) {
  EXPECT_EQ(absl::StrJoin(CheckReachability(ReadSourceTree()), "\n"), "");
}

TEST(ReachRules, WhatTheServerDoesNotNeedIsFound) {
  const std::vector<SourceFile> files = {
      ParseSource("server/main.cc", "#include \"core/gas/needed.h\"\n"),
      ParseSource("core/gas/needed.h", ""),
      ParseSource("core/gas/needed.cc", "#include \"core/gas/needed.h\"\n"),
      ParseSource("core/gas/rival.h", ""),
      ParseSource("core/gas/rival.cc", "#include \"core/gas/rival.h\"\n"),
      ParseSource("lab/program/main.cc", "#include \"core/gas/rival.h\"\n")};
  EXPECT_THAT(CheckReachability(files),
              ElementsAre("core/gas/rival.h is needed by the laboratory only",
                          "core/gas/rival.cc is needed by the laboratory only"));
}

TEST(ReachRules, ASourceWithoutAHeaderGoesWithTheOneThatItIncludesFirst) {
  const std::vector<SourceFile> files = {
      ParseSource("server/main.cc", "#include \"core/plan/rule.h\"\n"),
      ParseSource("core/plan/rule.h", ""),
      ParseSource("core/plan/best_rule.cc",
                  "#include \"core/plan/rule.h\"\n#include \"core/tour/tour.h\"\n"),
      ParseSource("core/tour/tour.h", ""),
      ParseSource("core/tour/way.cc", "#include \"core/tour/way.h\"\n")};
  EXPECT_THAT(CheckReachability(files),
              ElementsAre("core/tour/way.cc is needed by the laboratory only"));
}

TEST(ReachRules, TheOrderOfFilesDoesNotMatter) {
  const std::vector<SourceFile> files = {
      ParseSource("core/gas/needed.cc", "#include \"core/gas/needed.h\"\n"),
      ParseSource("core/gas/needed.h", "#include \"core/gas/part.h\"\n"),
      ParseSource("core/gas/part.h", ""),
      ParseSource("server/main.cc", "#include \"core/gas/needed.h\"\n")};
  EXPECT_THAT(CheckReachability(files), IsEmpty());
}

TEST(ReachRules, TheClientLibraryIsPublished) {
  EXPECT_THAT(CheckReachability({ParseSource("client/driver.h", "#include \"core/types/a.h\"\n"),
                                 ParseSource("core/types/a.h", "")}),
              IsEmpty());
}

TEST(ReachRules, ExamplesNeedNobody) {
  EXPECT_THAT(CheckReachability({ParseSource("client/examples/cpp/toy.cc", "")}), IsEmpty());
}

}  // namespace reach_rules_test
}  // namespace plumescout
