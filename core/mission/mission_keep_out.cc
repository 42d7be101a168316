// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Keep-out areas that change while robots drive.

#include <algorithm>
#include <utility>

#include "core/mission/mission.h"
#include "core/occupancy/keep_out.h"
#include "core/types/error_reason.h"
#include "core/types/keep_out.h"
#include "core/types/status_macros.h"

namespace plumescout {

absl::StatusOr<Applied> Mission::Change(const KeepOutChanged& change) {
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<Polygon> areas, AfterChange(options_->keep_out, change));
  if (CoversHomes(areas) && !CoversHomes(options_->keep_out)) {
    return TypedError(absl::StatusCode::kFailedPrecondition, reason::kKeepOutCoversHome,
                      "no robot could come home any more: every home would lie in an area");
  }
  KeepOutOf(std::move(areas));
  keep_out_revision_ = revision_ + 1;
  return Applied{};
}

// All of those that are known; false if none is.
bool Mission::CoversHomes(const std::vector<Polygon>& areas) const {
  if (options_->home) return IsKeptOut(areas, *options_->home);
  const std::vector<RobotId> robots = fleet_.Ids();
  bool any = false;
  const bool all = std::all_of(robots.begin(), robots.end(), [&](const RobotId& robot) {
    const std::optional<WayPoint> start = fleet_.StartOf(robot);
    any = any || start.has_value();
    return !start || IsKeptOut(areas, start->pose.position());
  });
  return any && all;
}

void Mission::KeepOutOf(std::vector<Polygon> areas) {
  MissionOptions options = *options_;
  options.keep_out = areas;
  options_ = std::make_shared<const MissionOptions>(std::move(options));
  changed_keep_out_ = std::move(areas);
  map_changed_since_snapshot_ = true;
}

std::optional<Point2> Mission::FindKeptOut(const Plan& plan) const {
  const GridGeometry& geometry = occupancy_.geometry();
  if (plan.belief_revision >= keep_out_revision_ || geometry.size() == 0) return std::nullopt;
  std::vector<Point2> way;
  for (const Waypoint& waypoint : plan.trajectory.waypoints) {
    way.push_back(waypoint.pose.position());
  }
  const auto cell = FirstKeptOut(KeptOutCells(options_->keep_out, geometry), way);
  return cell ? std::optional<Point2>(geometry.Center(*cell)) : std::nullopt;
}

}  // namespace plumescout
