// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "proto/convert/status.h"

namespace plumescout {
namespace field_test {

using ::testing::ElementsAre;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(FieldTest, RefusalSaysFieldValueAndRule) {
  const absl::Status status = CheckFinite("observation.pose.x_m", kNan);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(status.message(), "observation.pose.x_m = nan must be finite");
}

TEST(FieldTest, RefusalCarriesTheFieldForPrograms) {
  EXPECT_THAT(FieldViolations(CheckIntRange("page_size", -3, 0, 10)),
              ElementsAre(FieldViolation{"page_size", "= -3 must be in [0, 10]"}));
}

TEST(FieldTest, ChecksTakeTheirBoundsAndNothingBeyond) {
  EXPECT_TRUE(CheckRange("f", 1.0, 1.0, 2.0).ok());
  EXPECT_TRUE(CheckRange("f", 2.0, 1.0, 2.0).ok());
  EXPECT_FALSE(CheckRange("f", std::nextafter(2.0, 3.0), 1.0, 2.0).ok());
  EXPECT_TRUE(CheckNotNegative("f", 0.0).ok());
  EXPECT_FALSE(CheckPositive("f", 0.0).ok());
  EXPECT_TRUE(CheckIntRange("f", 2, 1, 2).ok());
  EXPECT_FALSE(CheckIntRange("f", 3, 1, 2).ok());
}

TEST(FieldTest, NoCheckTakesNanOrInfinity) {
  for (const double value : {kNan, kInfinity, -kInfinity}) {
    EXPECT_FALSE(CheckFinite("f", value).ok());
    EXPECT_FALSE(CheckPositive("f", value).ok());
    EXPECT_FALSE(CheckNotNegative("f", value).ok());
    EXPECT_FALSE(CheckRange("f", value, -1e308, 1e308).ok());
  }
}

TEST(FieldTest, RefusedStringsAreEscapedAndCut) {
  const absl::Status status = FieldError("name", std::string(1000, '\n'), "is bad");
  EXPECT_LT(status.message().size(), 250u);
  EXPECT_EQ(status.message().find('\n'), absl::string_view::npos);
}

TEST(FieldTest, JoinBuildsPaths) {
  EXPECT_EQ(Join("", "pose"), "pose");
  EXPECT_EQ(Join("batch", "pose"), "batch.pose");
  EXPECT_EQ(Join("batch", "observations", 3), "batch.observations[3]");
}

TEST(FieldTest, RefusalOfTheCoreGetsItsPlaceAndTheNameOfTheWire) {
  constexpr FieldName kRenamed[] = {{"scan.ranges", "scan.ranges_u16"}};
  const absl::Status core = absl::InvalidArgumentError("scan.ranges = 7 must be in [10, 20]");
  EXPECT_THAT(FieldViolations(WithField(core, "options", kRenamed)),
              ElementsAre(FieldViolation{"options.scan.ranges_u16", "= 7 must be in [10, 20]"}));
}

TEST(FieldTest, OtherErrorsPassUnchanged) {
  const absl::Status not_found = absl::NotFoundError("robot \"r\" is not registered");
  EXPECT_EQ(WithField(not_found, "options"), not_found);
  EXPECT_TRUE(WithField(absl::OkStatus(), "options").ok());
}

TEST(FieldTest, RefusalThatNamesItsFieldKeepsIt) {
  const absl::Status named = CheckFinite("start.x_m", kNan);
  EXPECT_EQ(WithField(named, "options"), named);
}

}  // namespace field_test
}  // namespace plumescout
