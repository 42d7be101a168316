// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/source_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumescout {
namespace source_tree_test {

using testing::ElementsAre;

TEST(SourceTree, CommentsAndLiteralsAreBlankedOut) {
  EXPECT_EQ(StripComments("a // b\nc"), "a     \nc");
  EXPECT_EQ(StripComments("a /* b\n */ c"), "a     \n    c");
  EXPECT_EQ(StripComments("f(\"{ // \\\" }\"); g"), "f(           ); g");
  EXPECT_EQ(StripComments("f('{', '\\'', 1'000)"), "f(   ,     , 1'000)");
  EXPECT_EQ(StripComments("f(R\"x(a\")x\"); g"), "f(         ); g");
}

TEST(SourceTree, IncludesAreReadAsWritten) {
  const SourceFile file = ParseSource("core/a.h",
                                      "#pragma once\n#include <vector>\n"
                                      "#include \"core/b.h\"\n// #include <c>\n");
  EXPECT_THAT(file.system_includes, ElementsAre("vector"));
  EXPECT_THAT(file.quoted_includes, ElementsAre("core/b.h"));
  EXPECT_TRUE(file.is_header());
  EXPECT_EQ(file.folder(), "core");
}

TEST(SourceTree, TheWholeProjectIsFound) {
  bool types = false;
  bool server = false;
  for (const SourceFile& file : ReadSourceTree()) {
    types = types || file.path == "core/types/cell.h";
    server = server || file.folder() == "server";
  }
  EXPECT_TRUE(types);
  EXPECT_TRUE(server);
}

}  // namespace source_tree_test
}  // namespace plumescout
