// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "core/types/ids.h"
#include "core/types/pose2.h"

namespace plumescout {

// What a robot has to know of itself without having asked.
struct RobotStanding {
  bool paused = false;    // its mission plans nothing until it is resumed
  bool finished = false;  // nothing changes its mission any more
  bool ordered_home = false;
  bool frame_suspect = false;  // its scans are not taken until its poses are corrected
  bool silent = false;         // see RobotState
  bool leased = false;         // somebody holds its lease

  friend bool operator==(const RobotStanding&, const RobotStanding&) = default;
};

enum class InvalidationReason {
  kMeetsRobot,  // another robot is not where it was to be
  kWayBlocked,  // something was seen to stand on the way
  kKeptOut,     // the way leads into an area where nobody may drive
  kSuperseded,  // the robot was given another
  kLapsed,      // it was not heard of for so long that the mission ended its plan
};

// A live plan that should not be driven any farther: to be reported as aborted, and the next one to
// be asked for. Advice: until then the plan is live.
struct PlanInvalidated {
  PlanId plan = 0;
  InvalidationReason reason = InvalidationReason::kMeetsRobot;
  RobotId robot = {};                          // that it meets
  double meets_in_s = 0.0;                     // when it meets that
  std::optional<Point2> place = std::nullopt;  // where on its way
  std::string detail = {};

  friend bool operator==(const PlanInvalidated&, const PlanInvalidated&) = default;
};

// A live plan that the robot did not ask for.
struct PlanAssigned {
  PlanId plan = 0;

  friend bool operator==(const PlanAssigned&, const PlanAssigned&) = default;
};

using RobotNotice = std::variant<RobotStanding, PlanInvalidated, PlanAssigned>;

}  // namespace plumescout
