// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/periodic_task.h"

#include <gtest/gtest.h>

#include "absl/synchronization/blocking_counter.h"

namespace plumescout::server {
namespace periodic_task_test {

TEST(PeriodicTaskTest, ItIsDoneAgainAndAgain) {
  constexpr int kTimes = 3;
  absl::BlockingCounter done(kTimes);
  int times = 0;  // touched by the task alone
  PeriodicTask task(absl::Milliseconds(1), [&] {
    if (times < kTimes) done.DecrementCount();
    ++times;
  });
  done.Wait();
}

TEST(PeriodicTaskTest, ItEndsAtOnceThoughItsPeriodIsLong) {
  PeriodicTask task(absl::Hours(1), [] { ADD_FAILURE() << "an hour has not passed"; });
}

}  // namespace periodic_task_test
}  // namespace plumescout::server
