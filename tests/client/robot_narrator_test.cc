// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_narrator.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace plumescout::client {
namespace robot_narrator_test {

TEST(RobotNarratorTest, SaysInALineEachWhatHappens) {
  RobotNarrator narrator("plumescout-test");
  Plan plan;
  plan.id = 3;
  plan.explanation = "nearest frontier";
  testing::internal::CaptureStderr();
  narrator.OnPlan({.time_ns = 0, .elapsed_s = 1.5, .pose = {}, .plan = plan, .rpc_wall = {}});
  narrator.OnReport(3, ProgressOutcome::kBlocked);
  narrator.OnLink(absl::UnavailableError("gone"));
  narrator.OnRolledBack(7, 2);
  narrator.OnPlaceDoubted(true);
  narrator.OnPlaceDoubted(false);
  RobotResult result;
  result.elapsed_s = 9.0;
  result.plans = 4;
  narrator.SayResult(result);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "plumescout-test: plan 3 at 1.5 s: nearest frontier\n"
            "plumescout-test: plan 3: blocked\n"
            "plumescout-test: link: UNAVAILABLE: gone\n"
            "plumescout-test: the server was set back: it has 7 observations of this robot, "
            "although it had more; the rest is sent again, but for 2 that are gone\n"
            "plumescout-test: scans contradict the map: the robot may not be where it says it is, "
            "and nothing that it senses counts until its poses are corrected or its scans fit "
            "again\n"
            "plumescout-test: scans fit the map again, or poses were corrected\n"
            "plumescout-test: done after 9 s: 4 plans, 0 m, 0 of 0 observations applied, "
            "0 durable\n");
}

TEST(RobotNarratorTest, AListenerHearsItWithItsWeight) {
  std::vector<std::string> heard;
  const auto listen = [&heard](bool is_warning, const std::string& line) {
    heard.push_back((is_warning ? "warning: " : "") + line);
  };
  RobotNarrator narrator("plumescout-test", listen);
  testing::internal::CaptureStderr();
  narrator.OnLink(absl::OkStatus());
  narrator.OnRejected({4, absl::InvalidArgumentError("no pose")});
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "plumescout-test: link is up\n"
            "plumescout-test: observation 4 refused: INVALID_ARGUMENT: no pose\n");
  EXPECT_EQ(heard, (std::vector<std::string>{
                       "link is up", "warning: observation 4 refused: INVALID_ARGUMENT: no pose"}));
}

}  // namespace robot_narrator_test
}  // namespace plumescout::client
