// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/departure.h"

#include <cmath>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/grid/escape.h"
#include "core/grid/flood.h"
#include "core/plan/paths/shortcut.h"
#include "core/traffic/traffic.h"
#include "core/types/error_reason.h"

namespace plumescout {
namespace {

// The pose `latency_s` after the robot's latest.
Pose2 ExpectedPose(const RobotRecord& robot, double latency_s, std::int64_t now_ns) {
  if (latency_s == 0.0 || robot.live_trajectory == nullptr) return robot.state.pose;
  const std::optional<NearestTime> now =
      FindOnWay(*robot.live_trajectory, robot.state.pose.position(), robot.live_gone_s);
  if (!now || !(now->distance_m <= kOffTrajectory_m)) return robot.state.pose;
  return PoseAt(*robot.live_trajectory, Progress_s(robot, now_ns) + latency_s);
}

}  // namespace

absl::StatusOr<Pose2> StartPose(const Belief& belief, const PlanRequest& request,
                                const RobotRecord& robot, const PlanningOptions& options) {
  if (!request.start && !robot.state.has_pose) {
    return absl::FailedPreconditionError(
        absl::StrCat("robot \"", request.robot, "\" has no pose yet"));
  }
  const Pose2 pose = request.start
                         ? *request.start
                         : ExpectedPose(robot, options.planning_latency_s, belief.sample_time_ns);
  const bool finite =
      std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.yaw_rad);
  const std::string place =
      absl::StrCat("start = (", pose.x_m, ", ", pose.y_m, ", ", pose.yaw_rad, ")");
  if (!finite) return absl::InvalidArgumentError(absl::StrCat(place, " must be finite"));
  if (!belief.occupancy->Contains(belief.geometry().CellAt(pose.position()))) {
    return TypedError(absl::StatusCode::kInvalidArgument, reason::kStartOutsideMap,
                      absl::StrCat(place, " must be inside the map"));
  }
  return pose;
}

std::optional<Departure> Depart(const Belief& belief, Point2 robot) {
  const Cell cell = belief.geometry().CellAt(robot);
  const std::vector<Cell> cells = EscapePath(*belief.occupancy, *belief.traversable, cell);
  if (cells.empty()) return std::nullopt;
  if (cells.size() == 1) return Departure{{}, robot};
  std::vector<Point2> way_out = {robot};
  for (const Cell c : cells) way_out.push_back(belief.geometry().Center(c));
  way_out = WithoutCollinear(way_out);
  const Point2 start = way_out.back();
  way_out.pop_back();
  return Departure{std::move(way_out), start};
}

Reach ReachFrom(const Belief& belief, Point2 place) {
  const GridGeometry& geometry = belief.geometry();
  const std::optional<Departure> departure = Depart(belief, place);
  if (!departure) return {geometry.CellAt(place), Grid<std::uint8_t>(geometry, 0)};
  const Cell start = geometry.CellAt(departure->start);
  return {start, ReachableCells(*belief.traversable, {start})};
}

}  // namespace plumescout
