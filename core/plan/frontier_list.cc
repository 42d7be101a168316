// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/frontier_list.h"

#include "absl/strings/str_cat.h"
#include "core/plan/departure.h"
#include "core/types/status_macros.h"

namespace plumescout {

absl::StatusOr<std::vector<JudgedFrontier>> ListFrontiers(const Belief& belief,
                                                          const RobotId& robot,
                                                          const PlanningOptions& options) {
  const auto found = belief.robots.find(robot);
  if (found == belief.robots.end()) {
    return absl::NotFoundError(absl::StrCat("robot \"", robot, "\" is not registered"));
  }
  PlanRequest request;
  request.robot = robot;
  const absl::StatusOr<Pose2> pose = StartPose(belief, request, found->second, options);
  // Nothing in the call said where the robot is.
  if (absl::IsInvalidArgument(pose.status())) {
    return absl::FailedPreconditionError(pose.status().message());
  }
  PLUMESCOUT_RETURN_IF_ERROR(pose.status());
  const Reach reach = ReachFrom(belief, pose->position());
  return JudgeFrontiers({belief, found->second, reach.start, reach.reachable, options});
}

}  // namespace plumescout
