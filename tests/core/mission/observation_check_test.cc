// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/observation_check.h"

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace plumescout {
namespace observation_check_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr std::int64_t kNow_ns = 1'000'000'000'000;

Observation GoodScan() {
  return {1, kNow_ns, {1.0, 2.0, 0.5}, Scan{-3.0, 0.1, 8.0, {1.0f, NAN, INFINITY}}};
}
Observation GoodGas() { return {1, kNow_ns, {1.0, 2.0, 0.5}, GasReading{3.0, 0.5}}; }

TEST(CheckObservation, AcceptsGoodObservations) {
  EXPECT_TRUE(CheckObservation(GoodScan(), MissionOptions{}, kNow_ns).ok());
  EXPECT_TRUE(CheckObservation(GoodGas(), MissionOptions{}, 0).ok());
}

TEST(CheckObservation, RefusesTheEndOfTimeEvenAtFirst) {
  Observation first = GoodGas();
  for (const std::int64_t time_ns : {std::int64_t{1} << 62, INT64_MAX}) {
    first.sample_time_ns = time_ns;
    const absl::Status status = CheckObservation(first, MissionOptions{}, 0);
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(std::string(status.message()), testing::HasSubstr(std::to_string(time_ns)));
  }
  first.sample_time_ns = (std::int64_t{1} << 62) - 1;
  EXPECT_TRUE(CheckObservation(first, MissionOptions{}, 0).ok());
}

struct BadCase {
  std::string field;
  std::function<void(Observation&)> spoil;
  Observation start;
};

class CheckObservationRefuses : public testing::TestWithParam<BadCase> {};

TEST_P(CheckObservationRefuses, AndNamesTheField) {
  Observation observation = GetParam().start;
  GetParam().spoil(observation);
  const absl::Status status = CheckObservation(observation, MissionOptions{}, kNow_ns);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), testing::HasSubstr(GetParam().field));
}

Scan& ScanOf(Observation& o) { return std::get<Scan>(o.payload); }
GasReading& GasOf(Observation& o) { return std::get<GasReading>(o.payload); }

INSTANTIATE_TEST_SUITE_P(
    EveryField, CheckObservationRefuses,
    testing::Values(
        BadCase{"sample_time_ns", [](Observation& o) { o.sample_time_ns = -1; }, GoodScan()},
        BadCase{"sample_time_ns", [](Observation& o) { o.sample_time_ns = INT64_MAX; }, GoodScan()},
        BadCase{"pose.x_m", [](Observation& o) { o.pose.x_m = kNan; }, GoodScan()},
        BadCase{"pose.x_m", [](Observation& o) { o.pose.x_m = 1001.0; }, GoodGas()},
        BadCase{"pose.y_m", [](Observation& o) { o.pose.y_m = -kInf; }, GoodGas()},
        BadCase{"pose.yaw_rad", [](Observation& o) { o.pose.yaw_rad = kNan; }, GoodScan()},
        BadCase{"scan.ranges", [](Observation& o) { ScanOf(o).ranges_m.clear(); }, GoodScan()},
        BadCase{"scan.ranges", [](Observation& o) { ScanOf(o).ranges_m.assign(1'000'000, 1.0f); },
                GoodScan()},
        BadCase{"scan.start_angle_rad", [](Observation& o) { ScanOf(o).start_angle_rad = kInf; },
                GoodScan()},
        BadCase{"scan.angle_step_rad", [](Observation& o) { ScanOf(o).angle_step_rad = 0.0; },
                GoodScan()},
        BadCase{"scan.angle_step_rad", [](Observation& o) { ScanOf(o).angle_step_rad = kNan; },
                GoodScan()},
        BadCase{"scan.max_range_m", [](Observation& o) { ScanOf(o).max_range_m = 0.0; },
                GoodScan()},
        BadCase{"scan.max_range_m", [](Observation& o) { ScanOf(o).max_range_m = kNan; },
                GoodScan()},
        BadCase{"scan.max_range_m", [](Observation& o) { ScanOf(o).max_range_m = 1e9; },
                GoodScan()},
        BadCase{"gas.concentration_ppm", [](Observation& o) { GasOf(o).concentration_ppm = -1.0; },
                GoodGas()},
        BadCase{"gas.concentration_ppm", [](Observation& o) { GasOf(o).concentration_ppm = kNan; },
                GoodGas()},
        BadCase{"gas.concentration_ppm", [](Observation& o) { GasOf(o).concentration_ppm = 2e6; },
                GoodGas()},
        BadCase{"gas.variance_ppm2", [](Observation& o) { GasOf(o).variance_ppm2 = -1.0; },
                GoodGas()},
        BadCase{"gas.variance_ppm2", [](Observation& o) { GasOf(o).variance_ppm2 = kNan; },
                GoodGas()},
        BadCase{"gas.variance_ppm2", [](Observation& o) { GasOf(o).variance_ppm2 = 1e-300; },
                GoodGas()}));

TEST(CheckStep, RefusesWhereTheRobotCannotHaveComeTo) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const WayPoint before{10 * kSecond_ns, {1.0, 2.0, 0.0}};
  const auto to = [&](double x_m, double after_s, double speed_mps = 20.0) {
    const auto time_ns = before.time_ns + std::llround(after_s * 1e9);
    return CheckStep(before, {time_ns, {x_m, 2.0, 3.0}}, speed_mps);
  };
  EXPECT_TRUE(to(5.9, 0.0).ok()) << "a jump of a localisation";
  const absl::Status status = to(8.1, 0.1);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()),
              testing::AllOf(testing::HasSubstr("pose = (8.10, 2.00)"),
                             testing::HasSubstr("7.10 m"), testing::HasSubstr("0.100 s"),
                             testing::HasSubstr("max_robot_speed_mps = 20")));
  EXPECT_TRUE(to(8.1, 0.2).ok()) << "at 20 m/s";
  EXPECT_FALSE(to(6.1, -3.0).ok()) << "a clock that was set back lets it go nowhere";
  EXPECT_TRUE(to(900.0, 0.0, 0.0).ok());
}

}  // namespace observation_check_test
}  // namespace plumescout
