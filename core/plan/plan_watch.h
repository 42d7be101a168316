// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/belief/belief.h"
#include "core/types/ids.h"
#include "core/types/robot_notice.h"

namespace plumescout {

struct PlanWatchOptions {
  // Meetings farther ahead are left to later looks: who is late may catch up.
  double horizon_s = 10.0;
  // What is in the way has to be there at every look for so long before somebody is told: robots
  // move on, and cells flicker. Areas that were just closed do not.
  double patience_s = 1.0;
  // Who has not moved by so much for patience_s, and should have driven on for as long, stands
  // where it is, whatever its plan says.
  double least_move_m = 0.1;
  // Beside both radii; less than what plans keep when they are committed, so that what poses err
  // brings no plan down.
  double clearance_m = 0.05;
};

// Looks at the live plans of a mission, now and then, for those that do not stand any more because
// a robot fell behind, stands or died, or because of what was seen meanwhile. Who was given its way
// later gives way, as in planning; who stands or strayed gives none, nor does who touches the
// other. Of one plan and cause is told once. It keeps what it saw at the looks before, and changes
// nothing. Thread-compatible.
class PlanWatch {
 public:
  struct News {
    RobotId robot;  // to be told
    RobotNotice notice;
  };

  explicit PlanWatch(const PlanWatchOptions& options = {}) : options_(options) {}

  // Times are the belief's. Cost: that of a Traffic for each robot that drives.
  std::vector<News> Look(const Belief& belief);

 private:
  using Cause = std::pair<InvalidationReason, RobotId>;
  // What is known of a robot's latest plan.
  struct Known {
    PlanId plan = 0;
    bool live = false;  // and leads somewhere
    bool assigned = false;
    std::map<Cause, std::int64_t> since_ns = {};  // of what is in its way
    std::set<Cause> told = {};
  };

  // Where a robot was when it last moved.
  struct Spot {
    Point2 place;
    std::int64_t since_ns = 0;
  };

  void NoteStanding(const Belief& belief);
  // Those that the robot has to give way to, as they are.
  std::map<RobotId, RobotRecord> BeforeIt(const Belief& belief, const RobotRecord& robot) const;
  std::optional<PlanInvalidated> NoteEnd(const RobotRecord& record, Known& known) const;
  // Keeps of what is in the way what was so before; returns what has been for long enough.
  std::vector<PlanInvalidated> Ripe(std::vector<PlanInvalidated> found, std::int64_t now_ns,
                                    Known& known) const;
  std::optional<PlanInvalidated> FindMeeting(const Belief& belief, const RobotRecord& record) const;

  PlanWatchOptions options_;
  std::map<RobotId, Known> known_;
  std::map<RobotId, Spot> spots_;
  std::set<RobotId> standing_;  // of the present look
  // Of the look before. A mission's options change with its keep-out areas, and with nothing else.
  std::shared_ptr<const MissionOptions> options_seen_;
  bool areas_are_new_ = false;  // since then
};

}  // namespace plumescout
