// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/objective.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace plumescout {
namespace objective_convert_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ObjectiveStatus Refuted() {
  return {ObjectiveState::kRefuted, 0.97, 2.5, 3, Point2{1, 2}, 34.0, 4.5, Point2{5, 6}, 7'000};
}

TEST(ObjectiveStatus, SurvivesTheRoundTrip) {
  const ObjectiveStatus untouched;
  for (const ObjectiveStatus& status : {Refuted(), untouched}) {
    const auto back = FromProto(ToProto(status), "objective");
    ASSERT_TRUE(back.ok()) << back.status();
    EXPECT_EQ(*back, status);
  }
}

TEST(ObjectiveStatus, RefusalsNameTheField) {
  using Break = void (*)(v1::ObjectiveStatus&);
  const std::pair<const char*, Break> cases[] = {
      {"objective.state", [](auto& proto) { proto.clear_state(); }},
      {"objective.confidence", [](auto& proto) { proto.set_confidence(kNan); }},
      {"objective.undecided_area_m2", [](auto& proto) { proto.set_undecided_area_m2(kNan); }},
      {"objective.mean_ppm", [](auto& proto) { proto.set_mean_ppm(kNan); }},
      {"objective.stddev_ppm", [](auto& proto) { proto.set_stddev_ppm(kNan); }},
      {"objective.place", [](auto& proto) { proto.mutable_place()->set_x_m(kNan); }},
      {"objective.strongest", [](auto& proto) { proto.mutable_strongest()->set_y_m(kNan); }},
  };
  for (const auto& [field, spoil] : cases) {
    v1::ObjectiveStatus proto = ToProto(Refuted());
    spoil(proto);
    const absl::Status refused = FromProto(proto, "objective").status();
    EXPECT_EQ(refused.code(), absl::StatusCode::kInvalidArgument) << field;
    EXPECT_THAT(std::string(refused.message()), testing::HasSubstr(field));
  }
}

}  // namespace objective_convert_test
}  // namespace plumescout
