// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/exit_timer.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace plumescout::server {
namespace exit_timer_test {

class ExitTimerTest : public testing::Test {
 protected:
  ExitTimerTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

void NeverEnd() {
  const ExitTimer timer(absl::Milliseconds(1), 5);
  absl::Notification never;
  never.WaitForNotification();
}

void EndInTime() {
  { const ExitTimer timer(absl::InfiniteDuration(), 5); }
  _exit(7);
}

TEST_F(ExitTimerTest, EndsAProcessThatDoesNotEnd) {
  EXPECT_EXIT(NeverEnd(), testing::ExitedWithCode(5), "stopped with work unfinished");
}

TEST_F(ExitTimerTest, LeavesAProcessAloneThatEndsInTime) {
  EXPECT_EXIT(EndInTime(), testing::ExitedWithCode(7), "");
}

}  // namespace exit_timer_test
}  // namespace plumescout::server
