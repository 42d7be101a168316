// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// In lockstep, links that are known to be down.
#include <gtest/gtest.h>

#include "client/robot_loop.h"
#include "tests/client/robot_loop_fixture.h"

namespace plumescout::client {
namespace robot_loop_link_test {

TEST_F(RobotLoopTest, TheWorldGoesOnWithoutALinkThatIsKnownToBeDown) {
  server_.set_script(Tour({{2, 0}, {2, 2}}));
  const std::int64_t start_ns = driver_.now_ns();
  bool is_down = false;
  std::int64_t applied_then = 0;
  driver_.on_advance = [&] {
    const double time_s = 1e-9 * static_cast<double>(driver_.now_ns() - start_ns);
    if (!is_down && time_s > 1.55 && time_s < 1.65) {  // on the way
      is_down = true;
      server_.BreakLink();
      applied_then = server_.applied();
    } else if (is_down && time_s > 5.95) {
      EXPECT_EQ(server_.applied(), applied_then);
      is_down = false;
      server_.MendLink();
    }
  };
  RobotLoopOptions options = Options(Pacing::kLockstep, Following::kIdeal);
  options.link_is_down = [&] { return is_down; };

  const absl::StatusOr<RobotResult> result = Run(options);

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->reached, 2);
  ASSERT_EQ(recorder_.plan_times_s.size(), 3u);
  EXPECT_NEAR(recorder_.plan_times_s[1], 6.0, 1e-6) << "it stood, and asked at once";
  EXPECT_TRUE(recorder_.failures.empty());
  EXPECT_EQ(server_.applied(), result->ingest.last_sequence);
  EXPECT_EQ(result->ingest.lost, 0);
  EXPECT_GT(result->ingest.last_sequence, applied_then + 44) << "ten scans a second meanwhile";
}

}  // namespace robot_loop_link_test
}  // namespace plumescout::client
