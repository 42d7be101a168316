// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/stop_signal.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace plumescout::server {
namespace stop_signal_test {

TEST(StopSignalTest, AWaitEndsInTime) {
  StopSignal stop;
  const SteadyTime until = SteadyNow() + std::chrono::milliseconds(5);
  EXPECT_FALSE(stop.AwaitStop(until));
  EXPECT_GE(SteadyNow(), until);
  EXPECT_FALSE(stop.AwaitStop(SteadyTime()));
}

TEST(StopSignalTest, WhoStopsEndsWaits) {
  StopSignal stop;
  std::thread waiter([&] { EXPECT_TRUE(stop.AwaitStop(SteadyNow() + std::chrono::hours(1))); });
  stop.Stop();
  waiter.join();
  EXPECT_TRUE(stop.AwaitStop(SteadyTime())) << "it stays so";
}

}  // namespace stop_signal_test
}  // namespace plumescout::server
