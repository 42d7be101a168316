// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace plumescout {
namespace options_test {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Options, AreValidByDefault) {
  EXPECT_TRUE(Validate(MissionOptions{}).ok());
  EXPECT_TRUE(Validate(OccupancyOptions{}).ok());
  EXPECT_TRUE(Validate(GasOptions{}).ok());
  EXPECT_TRUE(Validate(PublishedGasOptions()).ok());
  EXPECT_TRUE(Validate(FrontierOptions{}).ok());
  EXPECT_TRUE(Validate(PlanningOptions{}).ok());
}

// A field of type double, with values that it refuses besides NaN and infinity.
template <typename Options>
struct Field {
  const char* name;
  double Options::*member;
  std::vector<double> refused;
};

template <typename Options>
void ExpectRefused(const std::vector<Field<Options>>& fields) {
  for (const Field<Options>& field : fields) {
    std::vector<double> refused = field.refused;
    refused.insert(refused.end(), {kNan, kInfinity, -kInfinity});
    for (const double value : refused) {
      Options options;
      options.*field.member = value;
      const absl::Status status = Validate(options);
      EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << field.name << " = " << value;
      EXPECT_THAT(std::string(status.message()), HasSubstr(field.name));
    }
  }
}

TEST(ObjectiveOptions, RefuseValuesOutsideTheirRanges) {
  ExpectRefused<ObjectiveOptions>({
      {"threshold_ppm", &ObjectiveOptions::threshold_ppm, {-1.0, 1.1e6}},
      {"confidence", &ObjectiveOptions::confidence, {0.0, 0.5, 1.0}},
      {"radius_m", &ObjectiveOptions::radius_m, {-0.1, 101.0}},
      {"deadline_s", &ObjectiveOptions::deadline_s, {-1.0, 1.1e9}},
      {"hold_s", &ObjectiveOptions::hold_s, {-1.0, 3601.0}},
  });
}

TEST(ObjectiveOptions, AllButACompleteMapNeedAThreshold) {
  ObjectiveOptions options{.kind = ObjectiveKind::kConfirmClean};
  EXPECT_THAT(std::string(Validate(options).message()), HasSubstr("objective.threshold_ppm = 0"));
  options.threshold_ppm = 10.0;
  EXPECT_TRUE(Validate(options).ok());
}

TEST(MissionOptionsTest, RefuseValuesOutsideTheirRanges) {
  ExpectRefused<MissionOptions>({
      {"misleading_move_m", &MissionOptions::misleading_move_m, {-0.1, 10.1}},
      {"max_robot_speed_mps", &MissionOptions::max_robot_speed_mps, {-1.0, 1001.0}},
  });
}

TEST(OccupancyOptions, RefuseValuesOutsideTheirRanges) {
  ExpectRefused<OccupancyOptions>({
      {"resolution_m", &OccupancyOptions::resolution_m, {0.0, -0.1, 50.1}},
      {"inflation_radius_m", &OccupancyOptions::inflation_radius_m, {-0.1, 5.1}},
      {"free_threshold_probability", &OccupancyOptions::free_threshold_probability, {0.0, 0.5}},
      {"occupied_threshold_probability",
       &OccupancyOptions::occupied_threshold_probability,
       {0.5, 1.0}},
      {"hit_log_odds", &OccupancyOptions::hit_log_odds, {0.0, -1.0, 51.0}},
      {"miss_log_odds", &OccupancyOptions::miss_log_odds, {0.0, 1.0, -51.0}},
      {"clamp_log_odds", &OccupancyOptions::clamp_log_odds, {0.0, -1.0, 51.0}},
      {"max_extent_m", &OccupancyOptions::max_extent_m, {0.0, 20001.0}},
  });
}

TEST(OccupancyOptions, RefuseAClampShortOfAThreshold) {
  OccupancyOptions options;
  options.clamp_log_odds = std::log(3.0) - 0.01;  // of tau_free = 0.25
  EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument);
  options.clamp_log_odds = std::log(3.0) + 0.01;
  EXPECT_TRUE(Validate(options).ok());
}

TEST(GasOptions, RefuseValuesOutsideTheirRanges) {
  ExpectRefused<GasOptions>({
      {"prior_precision_per_ppm2", &GasOptions::prior_precision_per_ppm2, {0.0, -1.0}},
      {"observation_precision_per_ppm2", &GasOptions::observation_precision_per_ppm2, {0.0, -1.0}},
      {"background_precision_per_ppm2", &GasOptions::background_precision_per_ppm2, {0.0, -1.0}},
      {"background_mean_ppm", &GasOptions::background_mean_ppm, {-1.0}},
      {"ageing_half_life_s", &GasOptions::ageing_half_life_s, {-1.0, 1e-4, 2e9}},
      {"observation_stddev_share", &GasOptions::observation_stddev_share, {-0.1, 10.1}},
      {"refresh_period_s", &GasOptions::refresh_period_s, {0.0, -1.0, 0.009, 3601.0}},
  });
}

TEST(FrontierOptions, RefuseValuesOutsideTheirRanges) {
  ExpectRefused<FrontierOptions>({
      {"observed_variance_ratio", &FrontierOptions::observed_variance_ratio, {0.0, 11.0}},
      {"gas_percentile", &FrontierOptions::gas_percentile, {-1.0, 101.0}},
      {"min_gas_threshold_ppm", &FrontierOptions::min_gas_threshold_ppm, {0.0, -1.0}},
  });
}

TEST(FrontierOptions, RefuseGivenThresholdsThatAreNotPositive) {
  for (const double bad : {0.0, -1.0, kNan}) {
    FrontierOptions options;
    options.observed_variance_ppm2 = bad;
    EXPECT_FALSE(Validate(options).ok()) << bad;
    options = {};
    options.fixed_gas_threshold_ppm = bad;
    EXPECT_FALSE(Validate(options).ok()) << bad;
  }
}

TEST(FrontierOptions, RefuseClustersOfNoCells) {
  FrontierOptions options;
  options.min_occupancy_cell_count = 0;
  EXPECT_FALSE(Validate(options).ok());
  options = {};
  options.min_gas_cell_count = -1;
  EXPECT_FALSE(Validate(options).ok());
}

TEST(PlanningOptions, RefuseValuesOutsideTheirRanges) {
  ExpectRefused<PlanningOptions>({
      {"min_goal_distance_m", &PlanningOptions::min_goal_distance_m, {-0.1}},
      {"alpha_per_m", &PlanningOptions::alpha_per_m, {-1.0, 2e9}},
      {"beta", &PlanningOptions::beta, {-1.0, 2e9}},
      {"uniform_share", &PlanningOptions::uniform_share, {-0.1, 1.1}},
      {"radius_factor", &PlanningOptions::radius_factor, {0.0}},
      {"speed_mps", &PlanningOptions::speed_mps, {0.0, -1.0}},
      {"dwell_s", &PlanningOptions::dwell_s, {-1.0}},
      {"set_aside_s", &PlanningOptions::set_aside_s, {0.0, -1.0, 2e9}},
      {"max_acceleration_mps2", &PlanningOptions::max_acceleration_mps2, {-1.0, 1e-4, 101.0}},
      {"max_turn_rate_rad_per_s", &PlanningOptions::max_turn_rate_rad_per_s, {-1.0, 1e-4, 101.0}},
      {"travel_budget_m", &PlanningOptions::travel_budget_m, {-1.0, 2e9}},
      {"return_margin_share", &PlanningOptions::return_margin_share, {-0.1, 11.0}},
      {"planning_latency_s", &PlanningOptions::planning_latency_s, {-1.0, 61.0}},
      {"unseen_information_nats", &PlanningOptions::unseen_information_nats, {-1.0, 2e9}},
      {"max_connection_radius_m", &PlanningOptions::max_connection_radius_m, {-1.0, 1001.0}},
  });
}

std::string RefusalOf(const MissionOptions& options) {
  EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument);
  return std::string(Validate(options).message());
}

TEST(MissionOptions, RefuseAreasThatAreNone) {
  const Polygon triangle = {{{0, 0}, {1, 0}, {0, 1}}};
  MissionOptions options;
  options.keep_out = {triangle, {{{0, 0}, {1, 0}}}};
  EXPECT_EQ(RefusalOf(options), "keep_out[1].vertices = 2 must be in [3, 256]");
  options.keep_out = {{std::vector<Point2>(257)}};
  EXPECT_EQ(RefusalOf(options), "keep_out[0].vertices = 257 must be in [3, 256]");
  options.keep_out.assign(65, triangle);
  EXPECT_EQ(RefusalOf(options), "keep_out = 65 must be in [0, 64]");
  options.keep_out.assign(64, triangle);
  EXPECT_TRUE(Validate(options).ok());
  for (const double bad : {kNan, kInfinity, 1e7}) {
    options.keep_out = {triangle};
    options.keep_out[0].vertices[2].y_m = bad;
    EXPECT_THAT(RefusalOf(options), HasSubstr("keep_out[0].vertices[2].y_m = "));
  }
}

TEST(MissionOptions, RefuseAHomeThatNoPoseMayHave) {
  for (const double bad : {kNan, kInfinity, -1001.0}) {
    MissionOptions options;
    options.home = Point2{bad, 0.0};
    EXPECT_THAT(RefusalOf(options), HasSubstr("home.x_m = "));
    options.home = Point2{0.0, bad};
    EXPECT_THAT(RefusalOf(options), HasSubstr("home.y_m = "));
  }
}

TEST(MissionOptions, RefuseValuesOutsideTheirRanges) {
  ExpectRefused<MissionOptions>({
      {"pose_limit_m", &MissionOptions::pose_limit_m, {0.0}},
      {"max_range_m", &MissionOptions::max_range_m, {0.0}},
      {"max_concentration_ppm", &MissionOptions::max_concentration_ppm, {0.0}},
  });
}

TEST(MissionOptions, AreInvalidIfAnyPartIs) {
  MissionOptions options;
  options.gas.prior_precision_per_ppm2 = -1.0;
  EXPECT_EQ(Validate(options).message(), Validate(options.gas).message());
}

TEST(OpenLatticeVariance, FollowsItsFormula) {
  // ln(32 * 3 / 0.001) / (4 pi * 3), worked by hand: 11.47210 / 37.69911.
  EXPECT_NEAR(OpenLatticeVariance_ppm2(PublishedGasOptions()), 0.304307, 1e-6);
  // ln(32 * 3 / 0.009) / (4 pi * 3): 9.27488 / 37.69911.
  EXPECT_NEAR(OpenLatticeVariance_ppm2(GasOptions{}), 0.246024, 1e-6);
}

TEST(GasOptionsTest, ThePublishedOnesHaveTheRatiosOfXitTableOne) {
  const GasOptions published = PublishedGasOptions();
  EXPECT_EQ(published.prior_precision_per_ppm2, 3.0);
  EXPECT_EQ(published.observation_precision_per_ppm2, 10.0);
  EXPECT_EQ(published.background_precision_per_ppm2, 0.001);
}

}  // namespace options_test
}  // namespace plumescout
