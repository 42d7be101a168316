// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "core/belief/belief.h"
#include "core/types/ids.h"
#include "core/types/robot_notice.h"

namespace plumescout {

// What is known of a robot's latest plan that the robot has to hear.
struct PlanNews {
  std::optional<PlanInvalidated> invalidated;
  std::optional<PlanAssigned> assigned;
};

// What there is to tell the robots of one mission unasked, and when its live plans are to be looked
// at (PlanWatch) for more of that. Times are by any clock that begins at 0 or later and never goes
// back: a server's is its own, a study's the mission's sample time. Thread-compatible.
class RobotNewsBook {
 public:
  static constexpr std::int64_t kLookPeriod_ns = 500'000'000;

  // When a look is due.
  std::int64_t next_look_ns() const { return next_look_ns_; }
  void NoteLook(std::int64_t now_ns) { next_look_ns_ = now_ns + kLookPeriod_ns; }

  // The robots are those of `belief` from now on, and stand as it says; what was noted of plans
  // that are not their latest is forgotten.
  void Follow(const Belief& belief);
  // What a look has found.
  void Note(const RobotId& robot, const RobotNotice& notice);

  // But for what its mission and its lease say.
  RobotStanding StandingOf(const RobotId& robot) const;
  PlanNews PlanNewsOf(const RobotId& robot) const;

 private:
  struct Entry {
    RobotStanding standing;
    PlanNews plan;
  };

  std::map<RobotId, Entry> entries_;
  std::int64_t next_look_ns_ = 0;
};

}  // namespace plumescout
