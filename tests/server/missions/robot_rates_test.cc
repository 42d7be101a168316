// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/robot_rates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"
#include "tests/support/ingest_batch.h"

namespace plumescout::server {
namespace robot_rates_test {

class RobotRatesTest : public testing::Test {
 protected:
  RobotRates Rates(const RateOptions& options) {
    return RobotRates(options, [this] { return now_; });
  }

  SteadyTime now_ = SteadyTime() + std::chrono::hours(1);
};

TEST_F(RobotRatesTest, ABatchCountsForWhatIsInIt) {
  std::vector<IncomingObservation> batch = support::GasBatch(1, 3);
  batch.push_back({{4, 0, {}, Scan{}}, absl::InvalidArgumentError("unreadable")});
  batch.push_back({{5, 0, {}, SequenceGap{5, 9}}, absl::OkStatus()});
  const RateLoad load = RateLoadOf(batch, 77);
  EXPECT_EQ(load.gas_readings, 3.0);
  EXPECT_EQ(load.scans, 1.0);
  EXPECT_EQ(load.bytes, 77.0);
}

TEST_F(RobotRatesTest, EachRateIsHeldAndSaysWhenToTryAgain) {
  const RateOptions options{.scans_per_s = 2.0,
                            .gas_readings_per_s = 4.0,
                            .ingest_bytes_per_s = 8.0,
                            .ingest_burst = absl::Seconds(10)};
  for (const RateLoad& full :
       {RateLoad{.scans = 20.0}, RateLoad{.gas_readings = 40.0}, RateLoad{.bytes = 80.0}}) {
    RobotRates rates = Rates(options);
    ASSERT_TRUE(rates.AdmitBatch("r1", full).ok());
    const absl::Status refused = rates.AdmitBatch("r1", full);
    EXPECT_EQ(ErrorReason(refused), reason::kRateExceeded);
    EXPECT_EQ(RetryAfter_ns(refused), 10'000'000'000);
    EXPECT_TRUE(rates.AdmitBatch("r2", full).ok()) << "another robot";
    now_ += std::chrono::seconds(10);
    EXPECT_TRUE(rates.AdmitBatch("r1", full).ok());
  }
}

TEST_F(RobotRatesTest, ARefusedBatchCountsForNothing) {
  RobotRates rates = Rates({.scans_per_s = 1.0, .gas_readings_per_s = 1.0});
  ASSERT_TRUE(rates.AdmitBatch("r1", {.scans = 60.0}).ok());
  ASSERT_FALSE(rates.AdmitBatch("r1", {.scans = 1.0, .gas_readings = 60.0}).ok());
  EXPECT_TRUE(rates.AdmitBatch("r1", {.gas_readings = 60.0}).ok());
}

TEST_F(RobotRatesTest, WhatIsHereAlreadyIsPaidForByWaiting) {
  RobotRates rates = Rates({.scans_per_s = 10.0, .ingest_burst = absl::Seconds(1)});
  EXPECT_EQ(rates.CountBatch("r1", {.scans = 10.0}), absl::ZeroDuration());
  EXPECT_EQ(rates.CountBatch("r1", {.scans = 5.0}), absl::Milliseconds(500));
}

TEST_F(RobotRatesTest, PlansAreCountedByThemselves) {
  RobotRates rates = Rates({.scans_per_s = 1.0, .plans_per_s = 1.0});
  ASSERT_TRUE(rates.AdmitBatch("r1", {.scans = 60.0}).ok());
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(rates.AdmitPlan("r1").ok());
  const absl::Status refused = rates.AdmitPlan("r1");
  EXPECT_EQ(ErrorReason(refused), reason::kRateExceeded);
  EXPECT_EQ(RetryAfter_ns(refused), 1'000'000'000);
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("limits.max_plans_per_s = 1"));
}

TEST_F(RobotRatesTest, WhoHasNotCalledForLongStartsAnewAndWhoHasDoesNot) {
  RobotRates rates = Rates({.plans_per_s = 0.1});
  ASSERT_TRUE(rates.AdmitPlan("r1").ok());
  for (int i = 0; i < 1000; ++i) rates.CountBatch(absl::StrCat("x", i), {});
  EXPECT_FALSE(rates.AdmitPlan("r1").ok());
}

}  // namespace robot_rates_test
}  // namespace plumescout::server
