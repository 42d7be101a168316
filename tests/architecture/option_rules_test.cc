// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/option_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/architecture/source_tree.h"

namespace plumescout {
namespace option_rules_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string OptionHeaders() {
  return ReadText("core/types/options.h") + ReadText("core/types/site_options.h");
}

TEST(OptionRules, OptionsOfMissionsAreCalledTheSameInCoreAndOnTheWire) {
  EXPECT_THAT(CheckOptionNames(ReadText("proto/plumescout/v1/options.proto"), OptionHeaders()),
              IsEmpty());
}

TEST(OptionRules, OptionsOfTheServerAreCalledTheSameInItsFileAndItsCode) {
  EXPECT_THAT(CheckOptionNames(ReadText("proto/plumescout/config/v1/server_config.proto"),
                               ReadText("server/config/config.h")),
              IsEmpty());
}

constexpr char kProto[] = R"(
message GasOptions {
  // optional double prior = 9;
  optional double lambda_per_ppm2 = 1;
  Kind kind = 2;
  repeated Area areas = 3;
}
message Area {
  optional double width_m = 1;
}
)";

TEST(OptionRules, EveryKindOfMemberIsFound) {
  EXPECT_THAT(CheckOptionNames(kProto, R"(
struct GasOptions {
  double lambda_per_ppm2 = 3.0;  // lambda, > 0
  // Which; 1: none.
  Kind kind{Kind::kOne};
  std::vector<Area> areas;
};
)"),
              IsEmpty());
}

TEST(OptionRules, WhatOneOfTheTwoLacksIsNamed) {
  EXPECT_THAT(
      CheckOptionNames(kProto, R"(
struct GasOptions {
  double lambda = 3.0;
  Kind kind = Kind::kOne;
  std::vector<Area> areas;
};
struct PlanOptions {
  int n;
};
)"),
      ElementsAre("GasOptions.lambda_per_ppm2 is missing in the struct",
                  "GasOptions.lambda is missing in the message", "PlanOptions has no message"));
  EXPECT_THAT(CheckOptionNames(kProto, ""), ElementsAre("GasOptions has no struct"));
}

// The rules would pass if they found nothing to compare.
TEST(OptionRules, MembersThatAreTakenAwayAreMissed) {
  std::string header = OptionHeaders();
  header.replace(header.find("double commitment_margin_share"), 30,
                 "double commitment_margin_shame");
  EXPECT_THAT(CheckOptionNames(ReadText("proto/plumescout/v1/options.proto"), header),
              ElementsAre(HasSubstr("commitment_margin_share"), HasSubstr("margin_shame")));
}

}  // namespace option_rules_test
}  // namespace plumescout
