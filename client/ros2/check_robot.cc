// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/check_robot.h"

#include <memory>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/time.h"
#include "client/ros2/complaints.h"
#include "client/ros2/dds_node.h"
#include "client/ros2/input_watch.h"
#include "client/ros2/steady_clock.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;

}  // namespace

absl::StatusOr<bool> CheckRobot(ListenFlags flags, double seconds, const SayFn& say) {
  PLUMESCOUT_RETURN_IF_ERROR(Prepare(flags));
  Complaints complaints(say);
  RobotIntake intake(flags.intake, [&](const std::string& about, const absl::Status& why) {
    complaints.Add(about, std::string(why.message()), Steady_ns());
  });
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::unique_ptr<DdsNode> node, DdsNode::Open(flags.domain));
  PLUMESCOUT_RETURN_IF_ERROR(ListenToRobot(flags.topics, *node, intake));
  const InputWatch inputs(flags.topics, intake, *node);
  const std::int64_t begin_ns = Steady_ns();
  const auto end_ns = begin_ns + static_cast<std::int64_t>(seconds * kNanosecondsPerSecond);
  std::int64_t told_ns = begin_ns;
  std::vector<std::string> missing = {"everything"};
  while (!missing.empty() && Steady_ns() < end_ns) {
    node->Poll(absl::Milliseconds(100));
    while (intake.TakeScan(Steady_ns())) continue;
    while (intake.TakeGas(Steady_ns())) continue;
    for (const std::string& misfit : node->TakeMisfits()) say(misfit);
    missing = inputs.Missing();
    // DDS takes a while to find others.
    if (Steady_ns() - told_ns < Complaints::kSayAgain_ns) continue;
    told_ns = Steady_ns();
    for (const std::string& what : missing) say(absl::StrCat("waiting: ", what));
  }
  for (const std::string& what : missing) say(absl::StrCat("missing: ", what));
  say(Describe(intake.counters()));
  return missing.empty();
}

}  // namespace plumescout::client
