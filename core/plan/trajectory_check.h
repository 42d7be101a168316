// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "core/types/ids.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "core/types/trajectory_verdict.h"

namespace plumescout {

// A path that a robot means to drive, and what for.
struct IntendedPath {
  std::vector<Point2> vertices;    // frame map
  Goal goal;                       // its cell need not be of the belief's geometry
  std::vector<Point2> stops = {};  // vertices, in order, where it samples; if the goal is a site
};

// What is left of the robot's plan: its trajectory from the point nearest to the robot's latest
// pose on. Errors: kNotFound if the robot is unknown, or no plan has the number yet;
// kFailedPrecondition if the robot has a later plan (PLAN_SUPERSEDED), or its plan has ended or
// had nowhere to go (PLAN_ENDED).
absl::StatusOr<IntendedPath> RestOfPlan(const Belief& belief, const RobotId& robot, PlanId plan);

// Where the robot cannot follow the path, by the cells that it touches, as planning does: all must
// be traversable, but for a beginning in the inflated zone, which may lead out of it as EscapePath
// would. REQUIRES: as CheckTrajectory.
std::optional<Blockage> FindBlockage(const Belief& belief, const std::vector<Point2>& path);

// A path of the caller's own, to a goal of this kind at its end. REQUIRES: not empty.
IntendedPath PathTo(GoalKind kind, std::vector<Point2> vertices, const GridGeometry& geometry);

// Judges the path by FindBlockage. The goal is judged from the path's first vertex: a frontier is
// still worth it while one of the same kind that ClaimCovers is offered to this robot, for it moves
// as the robot sees more of it; being near is no objection. If there is none it is kGone. Home is
// worth it while it can be reached, another place while moreover nobody else claims it and it is
// not set aside; a site is kGone when all stops of the path have been sampled meanwhile and the
// strategy samples none twice. Whether another goal is better by now is a question for a new plan.
// The price is without information expected. REQUIRES: the robot is known; the path has a vertex;
// vertices are finite and fewer than 2^30 cells apart. Cost: O(cells).
TrajectoryVerdict CheckTrajectory(const Belief& belief, const RobotId& robot,
                                  const IntendedPath& path, const PlanningOptions& options);

}  // namespace plumescout
