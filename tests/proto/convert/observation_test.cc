// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/observation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "proto/convert/status.h"

namespace plumescout {
namespace observation_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Scan TestScan(std::vector<float> ranges_m) { return {-1.5, 0.01, 30.0, std::move(ranges_m)}; }

Observation TestObservation(decltype(Observation::payload) payload) {
  return {7, 1'700'000'000'000'000'000, {1.0, -2.0, 0.5}, std::move(payload)};
}

std::string RefusedField(const v1::Observation& proto) {
  const auto violations = FieldViolations(FromProto(proto, "observation").status());
  return violations.empty() ? "" : violations[0].field;
}

TEST(ObservationTest, GasAndGapSurviveTheRoundTrip) {
  for (const Observation& observation :
       {TestObservation(GasReading{12.5, 0.25}), TestObservation(SequenceGap{7, 90}),
        TestObservation(RobotStatus{0.5})}) {
    EXPECT_EQ(FromProto(ToProto(observation), "observation").value(), observation);
  }
}

TEST(ObservationTest, StatusNeedsNoPoseAndAShare) {
  v1::Observation proto = ToProto(TestObservation(RobotStatus{0.5}));
  proto.clear_pose();
  const auto status = FromProto(proto, "observation");
  ASSERT_TRUE(status.ok()) << status.status();
  EXPECT_EQ(status->pose, Pose2{});
  for (const double share : {-0.1, 2.0, kInfinity * 1.0, kNan * 1.0}) {
    proto.mutable_status()->set_battery_share(share);
    EXPECT_EQ(RefusedField(proto), "observation.status.battery_share");
  }
}

TEST(ObservationTest, ScanKeepsEverythingButHalfARangeUnit) {
  const Scan scan = TestScan({0.004f, 0.5f, 1.2345f, 29.999f});
  const Scan back = FromProto(ToProto(scan), "scan").value();
  EXPECT_EQ(back.start_angle_rad, scan.start_angle_rad);
  EXPECT_EQ(back.angle_step_rad, scan.angle_step_rad);
  EXPECT_EQ(back.max_range_m, scan.max_range_m);
  ASSERT_EQ(back.ranges_m.size(), scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    // Half of 5 mm, and the rounding of a float at 30 m.
    EXPECT_NEAR(back.ranges_m[i], scan.ranges_m[i], 0.0025 + 2e-6);
  }
}

TEST(ObservationTest, RangesUpTo327MetresAreWithinTwoAndAHalfMillimetres) {
  const Scan scan = TestScan({100.0013f, 327.66f});
  const v1::LaserScan proto = ToProto(scan);
  EXPECT_DOUBLE_EQ(proto.range_unit_m(), 0.005);
  const Scan back = FromProto(proto, "scan").value();
  EXPECT_NEAR(back.ranges_m[0], scan.ranges_m[0], 0.0025 + 8e-6);
  EXPECT_NEAR(back.ranges_m[1], scan.ranges_m[1], 0.0025 + 3e-5);
}

TEST(ObservationTest, LongerRangesWidenTheUnitUntilTheyFit) {
  const Scan back = FromProto(ToProto(TestScan({900.0f})), "scan").value();
  EXPECT_NEAR(back.ranges_m[0], 900.0, 900.0 / 65534 / 2 + 1e-4);
}

TEST(ObservationTest, NoReturnAndInvalidStayApart) {
  const Scan back =
      FromProto(ToProto(TestScan({kInfinity, kNan, -kInfinity, -1.0f, 0.0f, 0.001f})), "scan")
          .value();
  EXPECT_EQ(back.ranges_m[0], kInfinity);
  for (int i = 1; i <= 4; ++i) EXPECT_TRUE(std::isnan(back.ranges_m[static_cast<std::size_t>(i)]));
  EXPECT_GT(back.ranges_m[5], 0.0f);  // short, but seen: not to be confused with no return
  EXPECT_TRUE(std::isfinite(back.ranges_m[5]));
}

TEST(ObservationTest, GapNeedsNoPose) {
  v1::Observation proto = ToProto(TestObservation(SequenceGap{7, 90}));
  proto.clear_pose();
  EXPECT_TRUE(FromProto(proto, "observation").ok());
}

TEST(ObservationTest, RefusalSaysFieldAndValue) {
  v1::Observation proto = ToProto(TestObservation(GasReading{1.0, 0.0}));
  proto.mutable_pose()->set_x_m(kNan);
  EXPECT_EQ(FromProto(proto, "observation").status().message(),
            "observation.pose.x_m = nan must be finite");
}

struct BadField {
  const char* field;
  std::function<void(v1::Observation&)> spoil;
};

TEST(ObservationTest, EveryFieldOfAScanIsChecked) {
  const BadField kBad[] = {
      {"observation.sequence", [](auto& o) { o.set_sequence(0); }},
      {"observation.sequence", [](auto& o) { o.set_sequence(kMaxSequence + 1); }},
      {"observation.sample_time_ns", [](auto& o) { o.set_sample_time_ns(-1); }},
      {"observation.sample_time_ns", [](auto& o) { o.set_sample_time_ns(kMaxTime_ns + 1); }},
      {"observation.pose", [](auto& o) { o.clear_pose(); }},
      {"observation.payload", [](auto& o) { o.clear_payload(); }},
      {"observation.scan.start_angle_rad",
       [](auto& o) { o.mutable_scan()->set_start_angle_rad(kNan); }},
      {"observation.scan.start_angle_rad",
       [](auto& o) { o.mutable_scan()->set_start_angle_rad(7.0); }},
      {"observation.scan.angle_step_rad",
       [](auto& o) { o.mutable_scan()->set_angle_step_rad(kInfinity); }},
      {"observation.scan.max_range_m", [](auto& o) { o.mutable_scan()->set_max_range_m(-1.0); }},
      {"observation.scan.max_range_m", [](auto& o) { o.mutable_scan()->set_max_range_m(1e308); }},
      {"observation.scan.range_unit_m", [](auto& o) { o.mutable_scan()->set_range_unit_m(0.0); }},
      {"observation.scan.range_unit_m", [](auto& o) { o.mutable_scan()->set_range_unit_m(kNan); }},
      {"observation.scan.ranges_u16", [](auto& o) { o.mutable_scan()->set_ranges_u16("abc"); }},
      {"observation.scan.ranges_u16", [](auto& o) { o.mutable_scan()->clear_ranges_u16(); }},
      {"observation.scan.ranges_u16",
       [](auto& o) { o.mutable_scan()->set_ranges_u16(std::string(2'000'000, 'a')); }},
  };
  for (const BadField& bad : kBad) {
    v1::Observation proto = ToProto(TestObservation(TestScan({1.0f, 2.0f})));
    bad.spoil(proto);
    EXPECT_EQ(RefusedField(proto), bad.field);
  }
}

TEST(ObservationTest, EveryFieldOfAGasReadingIsChecked) {
  const BadField kBad[] = {
      {"observation.gas.concentration_ppm",
       [](auto& o) { o.mutable_gas()->set_concentration_ppm(-0.1); }},
      {"observation.gas.concentration_ppm",
       [](auto& o) { o.mutable_gas()->set_concentration_ppm(kInfinity); }},
      {"observation.gas.stddev_ppm", [](auto& o) { o.mutable_gas()->set_stddev_ppm(-1.0); }},
      {"observation.gas.stddev_ppm", [](auto& o) { o.mutable_gas()->set_stddev_ppm(kNan); }},
      // Its square would silently become "use the mission's model", or infinite.
      {"observation.gas.stddev_ppm", [](auto& o) { o.mutable_gas()->set_stddev_ppm(1e-200); }},
      {"observation.gas.stddev_ppm", [](auto& o) { o.mutable_gas()->set_stddev_ppm(1e200); }},
  };
  for (const BadField& bad : kBad) {
    v1::Observation proto = ToProto(TestObservation(GasReading{1.0, 0.5}));
    bad.spoil(proto);
    EXPECT_EQ(RefusedField(proto), bad.field);
  }
}

TEST(ObservationTest, GapMustBeginAtItsOwnNumberAndNotEndEarlier) {
  v1::Observation proto = ToProto(TestObservation(SequenceGap{7, 90}));
  proto.mutable_gap()->set_last_sequence(6);
  EXPECT_EQ(RefusedField(proto), "observation.gap.last_sequence");
  proto.mutable_gap()->set_last_sequence(90);
  proto.mutable_gap()->set_first_sequence(8);
  EXPECT_EQ(RefusedField(proto), "observation.gap.first_sequence");
}

TEST(ObservationTest, RefusalOfAMissionNamesTheFieldOfTheWire) {
  const absl::Status core = absl::InvalidArgumentError("gas.variance_ppm2 = 1e13 must be small");
  EXPECT_EQ(FieldViolations(RefusalFromCore(core, "observation")).at(0).field,
            "observation.gas.stddev_ppm");
}

}  // namespace observation_test
}  // namespace plumescout
