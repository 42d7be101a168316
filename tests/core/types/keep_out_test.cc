// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/keep_out.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "core/types/error_reason.h"

namespace plumescout {
namespace keep_out_types_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Polygon Triangle(const std::string& name) { return {{{0, 0}, {1, 0}, {0, 1}}, name}; }

std::vector<std::string> Names(const std::vector<Polygon>& areas) {
  std::vector<std::string> names;
  for (const Polygon& area : areas) names.push_back(area.name);
  return names;
}

std::string RefusalOf(const std::vector<Polygon>& areas) {
  return std::string(ValidateKeepOut(areas).message());
}

TEST(ValidateKeepOut, NamesMayBeLeftOutButNotComeTwice) {
  EXPECT_EQ(RefusalOf({Triangle(""), Triangle(""), Triangle("spill")}), "");
  EXPECT_EQ(RefusalOf({Triangle("spill"), Triangle("spill")}),
            "keep_out[1].name = \"spill\" is that of another area");
  EXPECT_THAT(RefusalOf({Triangle("Spill")}), HasSubstr("keep_out[0].name = \"Spill\""));
  EXPECT_THAT(RefusalOf({Triangle(std::string(64, 'a'))}), HasSubstr("keep_out[0].name"));
}

TEST(WithNames, GivesThoseThatAreFree) {
  EXPECT_THAT(Names(WithNames({Triangle(""), Triangle("area-2"), Triangle(""), Triangle("spill")})),
              ElementsAre("area-1", "area-2", "area-3", "spill"));
  EXPECT_TRUE(WithNames({}).empty());
}

TEST(AfterChange, WhatIsDeletedGoesFirst) {
  const std::vector<Polygon> before = {Triangle("a"), Triangle("b"), Triangle("c")};
  Polygon moved = Triangle("a");
  moved.vertices[0].x_m = -1.0;
  const auto after = AfterChange(before, {{"a", "b"}, {Triangle("d"), moved}});
  ASSERT_TRUE(after.ok()) << after.status();
  EXPECT_THAT(*after, ElementsAre(Triangle("c"), Triangle("d"), moved));
}

TEST(AfterChange, SaysWhatIsMissingAndWhatIsThereAlready) {
  const std::vector<Polygon> before = {Triangle("a")};
  const auto refusal = [&](const KeepOutChanged& change) {
    const absl::Status status = AfterChange(before, change).status();
    EXPECT_FALSE(status.ok());
    return std::string(ErrorReason(status));
  };
  EXPECT_EQ(refusal({{"b"}, {}}), reason::kKeepOutAreaNotFound);
  EXPECT_EQ(refusal({{"a", "a"}, {}}), reason::kKeepOutAreaNotFound) << "gone already";
  EXPECT_EQ(refusal({{}, {Triangle("a")}}), reason::kKeepOutAreaExists);
}

TEST(AfterChange, RefusesWhatIsNoAreaByField) {
  const auto refusal = [](const Polygon& area) {
    const absl::Status status = AfterChange({}, {{}, {Triangle("a"), area}}).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    return std::string(status.message());
  };
  EXPECT_THAT(refusal(Triangle("")), HasSubstr("added[1].name = \"\""));
  EXPECT_THAT(refusal(Triangle("a")), HasSubstr("added[1].name = \"a\""));
  EXPECT_EQ(refusal({{{0, 0}, {1, 0}}, "b"}), "added[1].vertices = 2 must be in [3, 256]");
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1.1e6, -1.1e6}) {
    Polygon area = Triangle("b");
    area.vertices[2].y_m = bad;
    EXPECT_THAT(refusal(area), HasSubstr("added[1].vertices[2].y_m = "));
  }
}

TEST(AfterChange, ThereIsRoomForSoMany) {
  std::vector<Polygon> areas(kMostKeepOutAreas, Triangle(""));
  areas = WithNames(std::move(areas));
  EXPECT_EQ(ErrorReason(AfterChange(areas, {{}, {Triangle("spill")}}).status()),
            reason::kLimitReached);
  EXPECT_TRUE(AfterChange(areas, {{"area-7"}, {Triangle("spill")}}).ok());
}

}  // namespace keep_out_types_test
}  // namespace plumescout
