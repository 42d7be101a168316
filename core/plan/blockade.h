// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/belief/belief.h"
#include "core/types/ids.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"

namespace plumescout {

// Who is so far behind its own plan stands, whatever it was to do.
inline constexpr double kStuck_s = 10.0;

// Whether the robot stands, for all that is known: it has no plan that it follows, or is stuck.
bool StandsStill(const RobotRecord& record, std::int64_t now_ns);

// Whether it stands without a plan that leads somewhere, and would go somewhere (wanted_goal).
bool StandsAndWants(const RobotRecord& record);

// A robot that cannot go where it wants to, or was to go, for as long as others stand where they
// do.
struct BlockedRobot {
  RobotId robot;
  double radius_m = 0.0;
  Goal goal;
  std::vector<Point2> way;  // the shortest to its goal if nobody stood there, in small steps
  std::vector<RobotId> by;  // who stands on that
  double waits_s = 0.0;
};

// Of those robots that stand and want to go somewhere (wanted_goal, or the goal of the plan that
// they are stuck on), the ones that have no way round those that stand. Robots keep Apart_m apart,
// and half a cell, or are no nearer than they are. In the order of ids. Cost: for each of them that
// of a flood and a grid search.
std::vector<BlockedRobot> FindBlockedRobots(const Belief& belief,
                                            const std::map<RobotId, RobotRecord>& robots,
                                            const PlanningOptions& options);

// The robots that wait for each other in a ring with this one, which is among them; none if it
// waits for nobody that, in the end, waits for it.
std::vector<BlockedRobot> FindRing(const std::vector<BlockedRobot>& blocked, const RobotId& robot);

// Closes the cells that the robot cannot stand in beside one that stands: nearer than Apart_m,
// or than it is now, to that one. Those where the robot `from` is remain open.
void CloseAround(const RobotState& standing, const RobotState& mover, Point2 from,
                 const PlanningOptions& options, Grid<std::uint8_t>& open);
// The same of a robot at `center` that has to be kept `apart_m` from.
void CloseDisc(Point2 center, double apart_m, Point2 from, Grid<std::uint8_t>& open);

// The traversable cells that are open to a robot at `from` beside all others that stand.
Grid<std::uint8_t> OpenTo(const Belief& belief, const std::map<RobotId, RobotRecord>& robots,
                          const RobotId& robot, Point2 from, const PlanningOptions& options);

}  // namespace plumescout
