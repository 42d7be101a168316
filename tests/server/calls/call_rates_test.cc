// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/call_rates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"

namespace plumescout::server {
namespace call_rates_test {

class CallRatesTest : public testing::Test {
 protected:
  // How many of so many calls are let in.
  int Admitted(CallRates& rates, const std::string& account, Rpc rpc, int calls) {
    int admitted = 0;
    for (int i = 0; i < calls; ++i) admitted += rates.Admit(account, rpc).ok() ? 1 : 0;
    return admitted;
  }

  SteadyTime now_ = SteadyTime() + std::chrono::hours(1);
  const SteadyClock clock_ = [this] { return now_; };
};

TEST_F(CallRatesTest, EachCallerHasItsOwnRateAndHearsWhenToTryAgain) {
  CallRates rates({.calls_per_s = 2.0}, clock_);
  EXPECT_EQ(Admitted(rates, "a", Rpc::kGetRobot, 30), 10) << "5 s worth at once";
  const absl::Status refused = rates.Admit("a", Rpc::kGetRobot);
  EXPECT_EQ(ErrorReason(refused), reason::kRateExceeded);
  EXPECT_EQ(RetryAfter_ns(refused), 500'000'000);
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("limits.max_calls_per_s = 2"));
  EXPECT_EQ(Admitted(rates, "b", Rpc::kGetRobot, 30), 10);
  now_ += std::chrono::seconds(1);
  EXPECT_EQ(Admitted(rates, "a", Rpc::kGetRobot, 30), 2);
}

TEST_F(CallRatesTest, WhatCostsMuchHasARateOfItsOwn) {
  CallRates rates({.calls_per_s = 10.0, .costly_calls_per_s = 1.0}, clock_);
  EXPECT_EQ(Admitted(rates, "a", Rpc::kGetMap, 30), 5);
  const absl::Status refused = rates.Admit("a", Rpc::kQueryGas);
  EXPECT_EQ(ErrorReason(refused), reason::kRateExceeded);
  EXPECT_EQ(RetryAfter_ns(refused), 1'000'000'000);
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("max_costly_calls_per_s = 1"));
  EXPECT_EQ(Admitted(rates, "a", Rpc::kGetRobot, 100), 45) << "what was refused is not counted";
}

TEST_F(CallRatesTest, WithoutARateAnyNumberPasses) {
  CallRates rates({}, clock_);
  EXPECT_EQ(Admitted(rates, "a", Rpc::kGetMap, 100'000), 100'000);
}

TEST_F(CallRatesTest, TheServerCanAlwaysBeDrained) {
  CallRates rates({.calls_per_s = 1.0}, clock_);
  EXPECT_EQ(Admitted(rates, "a", Rpc::kGetServerInfo, 30), 5);
  EXPECT_EQ(Admitted(rates, "a", Rpc::kDrainServer, 30), 30);
}

TEST_F(CallRatesTest, StrangersInMassesShareOneAccount) {
  CallRates rates({.calls_per_s = 1.0, .max_callers = 3}, clock_);
  for (const char* account : {"a", "b", "c"}) {
    EXPECT_EQ(Admitted(rates, account, Rpc::kGetRobot, 9), 5);
  }
  int admitted = 0;
  for (int i = 0; i < 100; ++i)
    admitted += Admitted(rates, absl::StrCat("s", i), Rpc::kGetRobot, 1);
  EXPECT_EQ(admitted, 5);
  EXPECT_EQ(Admitted(rates, "a", Rpc::kGetRobot, 1), 0) << "its account is not made anew";
  now_ += std::chrono::seconds(10);  // nobody called: all are forgotten
  EXPECT_EQ(Admitted(rates, "s1", Rpc::kGetRobot, 9), 5);
  EXPECT_EQ(Admitted(rates, "s2", Rpc::kGetRobot, 9), 5);
}

}  // namespace call_rates_test
}  // namespace plumescout::server
