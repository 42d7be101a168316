// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/proto_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/str_join.h"
#include "tests/architecture/source_tree.h"

namespace plumescout {
namespace proto_rules_test {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

TEST(ProtoRules, EveryNumberOnTheWireSaysItsUnit) {
  const auto paths = ListFiles("proto/plumescout", ".proto");
  ASSERT_THAT(paths, Not(IsEmpty()));
  for (const std::string& path : paths)
    EXPECT_EQ(absl::StrJoin(CheckUnits(path, ReadText(path)), "\n"), "");
}

TEST(ProtoRules, NumbersWithoutUnitAreFound) {
  EXPECT_THAT(
      CheckUnits("a.proto", R"(
// double height = 1;
message A {
  double height = 1;
  repeated int32 width_m = 2;
  optional uint64 speed = 3;
  string name = 4;
  bytes data = 5;
  bool ready = 6;
  int64 seed = 7;
}
)"),
      ElementsAre("a.proto: height does not say its unit", "a.proto: speed does not say its unit"));
}

TEST(ProtoRules, EveryNumberIsUsedOrReserved) {
  for (const std::string& path : ListFiles("proto/plumescout", ".proto"))
    EXPECT_EQ(absl::StrJoin(CheckNumbers(path, ReadText(path)), "\n"), "");
}

TEST(ProtoRules, SkippedNumbersAreFound) {
  EXPECT_THAT(CheckNumbers("a.proto", R"(
service S { rpc Call(A) returns (B) { option x = 3; } }
message A {
  reserved 2, 5 to 6;
  enum Kind { NONE = 0; ONE = 1; THREE = 3; }
  double a_m = 1;
  // double b_m = 3;
  oneof c { int32 d_m = 4; int32 e_m = 8; }
  message Inner { double f_m = 2 [deprecated = true]; }
}
)"),
              ElementsAre("a.proto: Kind neither uses nor reserves 2",
                          "a.proto: Inner neither uses nor reserves 1",
                          "a.proto: A neither uses nor reserves 3",
                          "a.proto: A neither uses nor reserves 7"));
}

}  // namespace proto_rules_test
}  // namespace plumescout
