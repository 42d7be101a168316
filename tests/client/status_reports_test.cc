// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/status_reports.h"

#include <gtest/gtest.h>

namespace plumescout::client {
namespace status_reports_test {

constexpr std::int64_t kPeriod_ns = StatusReports::kPeriod_ns;

TEST(StatusReportsTest, ChangesAreToldAtMostOnceAPeriodAndTheLatestWins) {
  StatusReports reports;
  EXPECT_FALSE(reports.Take(std::nullopt, 0).has_value());
  EXPECT_EQ(reports.Take(RobotStatus{1.0}, 1), RobotStatus{1.0});
  EXPECT_FALSE(reports.Take(RobotStatus{0.9}, 2).has_value());
  EXPECT_FALSE(reports.Take(RobotStatus{0.8}, kPeriod_ns).has_value());
  EXPECT_EQ(reports.Take(std::nullopt, kPeriod_ns + 1), RobotStatus{0.8});
}

TEST(StatusReportsTest, TheSameIsToldOnce) {
  StatusReports reports;
  reports.Take(RobotStatus{1.0}, 0);
  EXPECT_FALSE(reports.Take(RobotStatus{1.0}, 3 * kPeriod_ns).has_value());
}

TEST(StatusReportsTest, AClockThatWasSetBackKeepsNothingBack) {
  StatusReports reports;
  reports.Take(RobotStatus{1.0}, 5 * kPeriod_ns);
  EXPECT_EQ(reports.Take(RobotStatus{0.9}, kPeriod_ns), RobotStatus{0.9});
}

}  // namespace status_reports_test
}  // namespace plumescout::client
