// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/plan_start.h"

#include <cstddef>
#include <cstdint>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/plan/plan_seed.h"
#include "core/traffic/traffic.h"
#include "core/types/error_reason.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// Whether the place is so deep in the robot's body that one of two poses is wrong, whatever is left
// open of how their frames lie.
bool IsInside(Point2 place, const RobotState& self, const RobotState& other) {
  constexpr double kDeepShare = 0.5;
  const double radii_m = self.radius_m + other.radius_m;
  const double doubt_m = Reach_m(self, other, 0.0) - radii_m;
  return Distance_m(place, other.pose.position()) < kDeepShare * radii_m - doubt_m;
}

// Whether its latest pose tells where it is. Who follows a plan unheard has driven on since.
bool IsWhereItSaid(const RobotRecord& robot, std::int64_t now_ns) {
  constexpr std::int64_t kPosesCome_ns = 1'000'000'000;
  const bool drives_on = robot.live_trajectory != nullptr && now_ns - robot.pose_ns > kPosesCome_ns;
  const RobotState& state = robot.state;
  return state.has_pose && !state.silent && !state.frame_suspect && !drives_on;
}

// Of two the later, so that the other drives on and neither stands for ever.
bool CameLater(const RobotRecord& robot, const RobotRecord& other) {
  return robot.pose_ns != other.pose_ns ? robot.pose_ns > other.pose_ns
                                        : robot.state.id > other.state.id;
}

// That nobody starts where another is. A start that is given may be where the robot is, or about to
// be; else it is no place of the robot, and no fault of its pose.
absl::Status CheckApart(const Belief& belief, const PlanRequest& request,
                        const RobotRecord& robot) {
  const Point2 place = (request.start ? *request.start : robot.state.pose).position();
  const bool is_own =
      robot.state.has_pose && Distance_m(place, robot.state.pose.position()) <= kStartsAhead_m;
  if (is_own && robot.state.frame_suspect) return absl::OkStatus();
  for (const auto& [id, other] : belief.robots) {
    if (id == request.robot || !IsWhereItSaid(other, belief.sample_time_ns)) continue;
    if (!IsInside(place, robot.state, other.state)) continue;
    if (is_own && !CameLater(robot, other)) continue;
    return TypedError(
        is_own ? absl::StatusCode::kFailedPrecondition : absl::StatusCode::kInvalidArgument,
        reason::kStartInRobot,
        absl::StrFormat("start = (%.2f, %.2f) is %.2f m from robot \"%s\" at (%.2f, %.2f), whose "
                        "radius is %g m: both cannot be there",
                        place.x_m, place.y_m, Distance_m(place, other.state.pose.position()), id,
                        other.state.pose.x_m, other.state.pose.y_m, other.state.radius_m));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<PlanStart> BeginPlan(const Belief& belief, const PlanRequest& request,
                                    const PlanningOptions& options) {
  const auto robot = belief.robots.find(request.robot);
  if (robot == belief.robots.end()) {
    return absl::NotFoundError(absl::StrCat("robot \"", request.robot, "\" is not registered"));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const Pose2 pose, StartPose(belief, request, robot->second, options));
  if (options.yield_to_robots) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckApart(belief, request, robot->second));
  }
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
