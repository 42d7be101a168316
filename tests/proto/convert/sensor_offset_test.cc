// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/sensor_offset.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "proto/convert/status.h"

namespace plumescout {
namespace sensor_offset_convert_test {

const SensorOffset kDrifting = {"r1", "pid", 0.5, 0.1, 30, true, true, "ozone"};

TEST(SensorOffset, SurvivesTheRoundTrip) {
  const v1::SensorOffset proto = ToProto(kDrifting, "hall");
  EXPECT_EQ(proto.robot(), "missions/hall/robots/r1");
  const auto back = FromProto(proto, "sensor_offsets[0]");
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(*back, kDrifting);
}

TEST(SensorOffset, RefusalsNameTheField) {
  using Break = void (*)(v1::SensorOffset&);
  const std::pair<const char*, Break> cases[] = {
      {"offsets[1].robot", [](auto& proto) { proto.set_robot("r1"); }},
      {"offsets[1].offset_ppm",
       [](auto& proto) { proto.set_offset_ppm(std::numeric_limits<double>::quiet_NaN()); }},
      {"offsets[1].stddev_ppm", [](auto& proto) { proto.set_stddev_ppm(-0.1); }},
  };
  for (const auto& [field, spoil] : cases) {
    v1::SensorOffset proto = ToProto(kDrifting, "hall");
    spoil(proto);
    const auto violations = FieldViolations(FromProto(proto, "offsets[1]").status());
    ASSERT_EQ(violations.size(), 1u) << field;
    EXPECT_EQ(violations[0].field, field);
  }
}

}  // namespace sensor_offset_convert_test
}  // namespace plumescout
