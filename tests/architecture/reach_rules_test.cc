// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/reach_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/str_join.h"

namespace plumescout {
namespace reach_rules_test {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ReachRules, TheProjectKeepsTheLaboratoryApart) {
  const auto published = PublishedHeaders("client", ReadText("client/CMakeLists.txt"));
  EXPECT_THAT(published, Contains("client/robot_driver.h"));
  EXPECT_EQ(absl::StrJoin(CheckReachability(ReadSourceTree(), published), "\n"), "");
}

TEST(ReachRules, WhatTheServerDoesNotNeedIsFound) {
  const std::vector<SourceFile> files = {
      ParseSource("server/main.cc", "#include \"core/gas/needed.h\"\n"),
      ParseSource("core/gas/needed.h", ""),
      ParseSource("core/gas/needed.cc", "#include \"core/gas/needed.h\"\n"),
      ParseSource("core/gas/rival.h", ""),
      ParseSource("core/gas/rival.cc", "#include \"core/gas/rival.h\"\n"),
      ParseSource("lab/program/main.cc", "#include \"core/gas/rival.h\"\n")};
  EXPECT_THAT(CheckReachability(files, {}),
              ElementsAre("core/gas/rival.h is needed by the laboratory only",
                          "core/gas/rival.cc is needed by the laboratory only"));
}

TEST(ReachRules, ASourceWithoutAHeaderGoesWithTheFirstOfItsFolderThatItIncludes) {
  const std::vector<SourceFile> files = {
      ParseSource("server/main.cc",
                  "#include \"core/plan/rule.h\"\n#include \"core/types/macros.h\"\n"),
      ParseSource("core/plan/rule.h", ""),
      ParseSource("core/plan/best_rule.cc",
                  "#include \"absl/status/status.h\"\n#include \"core/plan/rule.h\"\n"
                  "#include \"core/tour/tour.h\"\n"),
      ParseSource("core/types/macros.h", ""),
      ParseSource("core/tour/tour.h", ""),
      ParseSource("core/tour/way.h", ""),
      ParseSource("core/tour/way_home.cc",
                  "#include \"absl/status/status.h\"\n#include \"core/types/macros.h\"\n"
                  "#include \"core/tour/way.h\"\n"),
      ParseSource("core/tour/lost.cc", "#include \"core/types/macros.h\"\n")};
  EXPECT_THAT(CheckReachability(files, {}),
              ElementsAre("core/tour/way.h is needed by the laboratory only",
                          "core/tour/way_home.cc is needed by the laboratory only",
                          "core/tour/lost.cc is needed by the laboratory only"));
}

TEST(ReachRules, TheOrderOfFilesDoesNotMatter) {
  const std::vector<SourceFile> files = {
      ParseSource("core/gas/needed.cc", "#include \"core/gas/needed.h\"\n"),
      ParseSource("core/gas/needed.h", "#include \"core/gas/part.h\"\n"),
      ParseSource("core/gas/part.h", ""),
      ParseSource("server/main.cc", "#include \"core/gas/needed.h\"\n")};
  EXPECT_THAT(CheckReachability(files, {}), IsEmpty());
}

TEST(ReachRules, OfTheClientWhatIsPublishedNeedsNobody) {
  const std::string lists =
      "plumescout_library(client SOURCES driver.cc)\nplumescout_publish(client\n"
      "  LIBRARIES client\n  HEADERS driver.h\n          robot.h)\nadd_subdirectory(ros2)\n";
  const auto published = PublishedHeaders("client", lists);
  EXPECT_THAT(published, ElementsAre("client/driver.h", "client/robot.h"));
  const std::vector<SourceFile> files = {
      ParseSource("client/driver.h", "#include \"core/types/a.h\"\n"),
      ParseSource("core/types/a.h", ""), ParseSource("client/unused.h", "")};
  EXPECT_THAT(CheckReachability(files, published),
              ElementsAre("client/unused.h is needed by the laboratory only"));
  EXPECT_THAT(PublishedHeaders("client", ""), IsEmpty());
}

TEST(ReachRules, ExamplesNeedNobody) {
  EXPECT_THAT(CheckReachability({ParseSource("client/examples/cpp/toy.cc", "")}, {}), IsEmpty());
}

}  // namespace reach_rules_test
}  // namespace plumescout
