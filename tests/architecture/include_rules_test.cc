// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/include_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_join.h"
namespace plumescout {
namespace include_rules_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// A tree of files given by path and text.
std::vector<SourceFile> Tree(const std::vector<std::pair<std::string, std::string>>& texts) {
  std::vector<SourceFile> files;
  for (const auto& [path, text] : texts) files.push_back(ParseSource(path, text));
  return files;
}

TEST(IncludeRules, TheProjectKeepsItsDirections) {
  EXPECT_EQ(absl::StrJoin(CheckDirections(ReadSourceTree()), "\n"), "");
}

TEST(IncludeRules, TheProjectHasNoCycles) {
  EXPECT_EQ(absl::StrJoin(CheckCycles(ReadSourceTree()), "\n"), "");
}

TEST(IncludeRules, TheProjectKeepsPlatformHeadersInTheirPlaces) {
  EXPECT_EQ(absl::StrJoin(CheckPlatformHeaders(ReadSourceTree()), "\n"), "");
}

TEST(IncludeRules, CoreReachesForNothingOutside) {
  EXPECT_EQ(absl::StrJoin(CheckImpureCalls(ReadSourceTree()), "\n"), "");
}

TEST(IncludeRules, AnIncludeAgainstTheDirectionIsFound) {
  EXPECT_THAT(CheckDirections(Tree({{"core/gas/a.h", "#include \"core/plan/b.h\"\n"},
                                    {"core/plan/b.h", "#include \"core/types/c.h\"\n"},
                                    {"core/types/c.h", ""}})),
              ElementsAre("core/gas/a.h must not include core/plan/b.h"));
  EXPECT_THAT(
      CheckDirections(Tree({{"client/a.h", "#include \"server/b.h\"\n"}, {"server/b.h", ""}})),
      SizeIs(1));
}

TEST(IncludeRules, ARoomWithinAnotherIsARoomOfItsOwn) {
  const auto tree = Tree({{"core/mission/a.h", "#include \"core/mission/conduct/b.h\"\n"},
                          {"core/mission/c.h", ""},
                          {"core/mission/conduct/b.h", "#include \"core/mission/c.h\"\n"}});
  EXPECT_THAT(CheckDirections(tree),
              ElementsAre("core/mission/a.h must not include core/mission/conduct/b.h"));
}

TEST(IncludeRules, FoldersAndFilesThatAreNotKnownAreFound) {
  EXPECT_THAT(CheckDirections(Tree({{"core/misc/a.h", ""}})),
              ElementsAre("core/misc/a.h lies in no folder of the table"));
  EXPECT_THAT(CheckDirections(Tree({{"core/gas/a.h", "#include \"b.h\"\n"}})),
              ElementsAre("core/gas/a.h includes b.h, which is no file"));
}

TEST(IncludeRules, CyclesOfFilesAreFound) {
  EXPECT_THAT(CheckCycles(Tree({{"core/gas/a.h", "#include \"core/gas/b.h\"\n"},
                                {"core/gas/b.h", "#include \"core/gas/c.h\"\n"},
                                {"core/gas/c.h", "#include \"core/gas/b.h\"\n"}})),
              ElementsAre("core/gas/b.h -> core/gas/c.h -> core/gas/b.h"));
}

TEST(IncludeRules, CyclesOfFoldersAreFoundWithoutOneOfFiles) {
  EXPECT_THAT(CheckCycles(Tree({{"lab/bench/a.h", "#include \"lab/program/b.h\"\n"},
                                {"lab/program/c.h", "#include \"lab/bench/d.h\"\n"}})),
              ElementsAre("lab/bench -> lab/program -> lab/bench"));
}

TEST(IncludeRules, CyclesOfSubfoldersAreFound) {
  EXPECT_THAT(CheckCycles(Tree({{"core/plan/a.h", "#include \"core/plan/paths/b.h\"\n"},
                                {"core/plan/c.h", ""},
                                {"core/plan/paths/b.h", "#include \"core/plan/c.h\"\n"}})),
              ElementsAre("core/plan -> core/plan/paths -> core/plan"));
}

TEST(IncludeRules, ASubfolderIsARoomOfItsOwn) {
  EXPECT_THAT(CheckDirections(Tree({{"core/plan/paths/a.h", "#include \"core/plan/b.h\"\n"},
                                    {"core/plan/b.h", "#include \"core/plan/cost/c.h\"\n"},
                                    {"core/plan/cost/c.h", ""}})),
              ElementsAre("core/plan/paths/a.h must not include core/plan/b.h"));
}

TEST(IncludeRules, PlatformHeadersOutOfPlaceAreFound) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"core/gas/a.cc", "#include <thread>\n"},
      {"core/gas/a.cc", "#include \"absl/time/clock.h\"\n"},
      {"core/gas/a.cc", "#include \"plumescout/v1/types.pb.h\"\n"},
      {"core/gas/a.cc", "#include <cholmod.h>\n"},
      {"core/linalg/a.h", "#include <cholmod.h>\n"},
      {"lab/linalg/a.h", "#include <cholmod.h>\n"},
      {"lab/sim/a.cc", "#include <cholmod.h>\n"},
      {"core/plan/a.cc", "#include <glpk.h>\n"},
      {"core/tour/a.h", "#include <glpk.h>\n"},
      {"core/plan/a.cc", "#include <ompl/base/Planner.h>\n"},
      {"ompl_planners/a.h", "#include <ompl/base/Planner.h>\n"},
      {"tests/ompl_planners/a_test.cc", "#include <ompl/base/Planner.h>\n"},
      {"server/missions/a.cc", "#include <sqlite3.h>\n"},
      {"server/store/a.h", "#include <sqlite3.h>\n"},
      {"lab/bench/a.cc", "#include <sqlite3.h>\n"},
      {"server/a.cc", "#include <libpq-fe.h>\n"},
      {"server/store/a.h", "#include <libpq-fe.h>\n"},
      {"proto/convert/a.cc", "#include <grpcpp/grpcpp.h>\n"},
      {"lab/sim/a.h", "#include <grpcpp/grpcpp.h>\n"},
  };
  for (const auto& file : cases) {
    EXPECT_THAT(CheckPlatformHeaders(Tree({file})), SizeIs(1)) << file.first << ": " << file.second;
  }
}

TEST(IncludeRules, OmplIsIncludedWhereItBelongs) {
  EXPECT_THAT(
      CheckPlatformHeaders(Tree({{"ompl_planners/a.cc", "#include <ompl/base/Planner.h>\n"}})),
      IsEmpty());
}

TEST(IncludeRules, DatabasesAreIncludedWhereTheyBelong) {
  EXPECT_THAT(CheckPlatformHeaders(Tree({{"server/store/a.cc", "#include <sqlite3.h>\n"},
                                         {"server/store/b.cc", "#include <sqlite3.h>\n"},
                                         {"server/store/c.cc", "#include <libpq-fe.h>\n"}})),
              IsEmpty());
}

TEST(IncludeRules, ASecondUserOfCholmodIsFound) {
  EXPECT_THAT(CheckPlatformHeaders(Tree({{"core/linalg/a.cc", "#include <cholmod.h>\n"},
                                         {"lab/linalg/b.cc", "#include <cholmod.h>\n"}})),
              IsEmpty());
  EXPECT_THAT(CheckPlatformHeaders(Tree({{"core/linalg/a.cc", "#include <cholmod.h>\n"},
                                         {"core/linalg/b.cc", "#include <cholmod.h>\n"}})),
              ElementsAre(HasSubstr("several users")));
}

TEST(IncludeRules, ASecondUserOfGlpkIsFound) {
  const char* const solver = "#include <glpk.h>\n";
  EXPECT_THAT(CheckPlatformHeaders(Tree({{"core/tour/a.cc", solver}})), IsEmpty());
  EXPECT_THAT(CheckPlatformHeaders(Tree({{"core/tour/a.cc", solver}, {"core/tour/b.cc", solver}})),
              ElementsAre("several users of GLPK: core/tour/a.cc, core/tour/b.cc"));
}

TEST(IncludeRules, ImpureCallsAreFoundButNotInComments) {
  EXPECT_THAT(CheckImpureCalls(Tree({{"core/gas/a.cc", "int x = rand();\n"}})),
              ElementsAre("core/gas/a.cc calls rand"));
  EXPECT_THAT(CheckImpureCalls(Tree({{"core/gas/a.cc", "// rand()\nint operand(int);\n"}})),
              IsEmpty());
}

}  // namespace include_rules_test
}  // namespace plumescout
