// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "core/plan/departure.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/plan_request.h"

namespace plumescout {

// What every plan begins with.
struct PlanStart {
  const RobotRecord& robot;  // of the belief
  Pose2 pose;                // where the plan begins
  Plan plan;                 // names, revision and seed filled in; to stay, for want of more
  // None, with the plan ended as kStartOccupied, if there is no way out to where it may drive.
  std::optional<Departure> departure;
};

// Errors: kNotFound if the robot is unknown; else as StartPose; and, if plans yield to robots,
// START_IN_ROBOT where another one is heard to be: kInvalidArgument for a start that is given and
// far from the robot, kFailedPrecondition for its own place, if its pose is later than the other's.
// Robots that lost their place, or drive on unheard, are passed over. Cost: as Depart, O(robots).
absl::StatusOr<PlanStart> BeginPlan(const Belief& belief, const PlanRequest& request,
                                    const PlanningOptions& options);

// Puts the common way out of the inflated zone before the candidate's path. It counts as length;
// its cells have no information penalty, and no choice depends on it.
void PutBefore(const std::vector<Point2>& way_out, Candidate& candidate);

// What a search that was stopped before it found any path ends with.
absl::Status StoppedBeforeAnyPath();

}  // namespace plumescout
