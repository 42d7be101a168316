// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/size_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "absl/strings/str_join.h"
namespace plumescout {
namespace size_rules_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

auto Function(const std::string& name, int lines) {
  return AllOf(Field(&FunctionSize::head, HasSubstr(name)),
               Field(&FunctionSize::code_lines, lines));
}

std::string Repeat(const std::string& line, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += line;
  return text;
}

TEST(SizeRules, TheProjectKeepsItsSizes) {
  EXPECT_EQ(absl::StrJoin(CheckSizes(ReadSourceTree()), "\n"), "");
}

TEST(SizeRules, BlanksCommentsAndDirectivesAreNoCode) {
  EXPECT_EQ(
      CountCodeLines(ParseSource("a.h", "#pragma once\n\n// comment\nint a;  // b\n/*\n*/\n")), 1);
}

TEST(SizeRules, FunctionsAreFoundWhereverTheyStand) {
  const SourceFile file = ParseSource("core/a.cc", R"(
#define MACRO(x) { x }
namespace a {
int Free(int b = {}) {
  if (b) {
    return 1;
  }
  return 2;
}
template <typename T>
class B : public C {
 public:
  B() : d_{1}, e_(2) { f(); }
  bool operator==(const B&) const { return true; }
  int d_ = 3;
  std::vector<int> g_ = {1, 2};
};
constexpr int kTable[] = {
    1,
    2};
const auto kLambda = [](int x) {
  return x;
};
TEST(A, B) {
  EXPECT_TRUE(c);
}
}
)");
  EXPECT_THAT(MeasureFunctions(file),
              ElementsAre(Function("int Free", 6), Function("B() : d_{1}, e_(2)", 1),
                          Function("operator==", 1), Function("TEST(A, B)", 3)));
}

TEST(SizeRules, FilesAndFunctionsBeyondTheirLimitsAreFound) {
  EXPECT_THAT(CheckSizes({ParseSource("core/a.cc", Repeat("int a;\n", 351))}),
              ElementsAre(HasSubstr("351 code lines")));
  EXPECT_THAT(CheckSizes({ParseSource("core/a.h", Repeat("int a;\n", 181))}),
              ElementsAre(HasSubstr("181 code lines")));
  EXPECT_THAT(
      CheckSizes({ParseSource("core/a.cc", "int F() {\n" + Repeat("  g();\n", 59) + "}\n")}),
      ElementsAre(HasSubstr("61 lines")));
  EXPECT_THAT(
      CheckSizes({ParseSource("core/a.cc", "int F() {\n" + Repeat("  g();\n", 58) + "}\n")}),
      IsEmpty());
}

}  // namespace size_rules_test
}  // namespace plumescout
