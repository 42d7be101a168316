// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/plan_start.h"

#include <cstddef>

#include "absl/strings/str_cat.h"
#include "core/plan/plan_seed.h"
#include "core/types/error_reason.h"
#include "core/types/status_macros.h"

namespace plumescout {

absl::StatusOr<PlanStart> BeginPlan(const Belief& belief, const PlanRequest& request,
                                    const PlanningOptions& options) {
  const auto robot = belief.robots.find(request.robot);
  if (robot == belief.robots.end()) {
    return absl::NotFoundError(absl::StrCat("robot \"", request.robot, "\" is not registered"));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const Pose2 pose, StartPose(belief, request, robot->second, options));
  PlanStart start{robot->second, pose, {}, Depart(belief, pose.position())};
  start.plan.robot = request.robot;
  start.plan.strategy = options.strategy;
  start.plan.belief_revision = belief.revision;
  start.plan.seed = request.seed != 0 ? request.seed
                                      : DerivedPlanSeed(belief.options->seed, request.robot,
                                                        robot->second.plans_issued);
  start.plan.phase = MissionPhase::kFallback;
  if (start.departure) {
    start.departure->yaw_rad = pose.yaw_rad;
    start.plan.start_escaped = !start.departure->way_out.empty();
  } else {
    start.plan.end = PlanEnd::kStartOccupied;
  }
  return start;
}

void PutBefore(const std::vector<Point2>& way_out, Candidate& candidate) {
  candidate.path.insert(candidate.path.begin(), way_out.begin(), way_out.end());
  for (std::size_t i = 0; i < way_out.size(); ++i) {
    candidate.length_m += Distance_m(candidate.path[i], candidate.path[i + 1]);
  }
}

absl::Status StoppedBeforeAnyPath() {
  return TypedError(absl::StatusCode::kDeadlineExceeded, reason::kDeadlineBeforeFirstPlan,
                    "planning was stopped before any path was found");
}

}  // namespace plumescout
