// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/frontier/goal_cells.h"
#include "core/plan/goals/frontier_goals.h"
#include "core/plan/goals/goal_offer.h"
#include "core/types/cell.h"
#include "core/types/ids.h"

namespace plumescout {

// Balanced areas (options.balanced_areas, ours): what a robot can reach, shared out among all
// robots that have a pose there, are heard of and are not sent home. A place belongs to the robot
// with the least way to it plus handicap; a robot has the greater a handicap the more there is to
// do near it, so that all are left about as much. To do are cells whose gas is not observed, and a
// strip behind each edge of the unseen. Where robots crowd, or work comes in lumps, loads differ by
// what no handicaps can even out. Areas follow the robots from plan to plan: nothing is remembered.
class OwnArea {
 public:
  // Of the robot of the query; none if it has nobody to share with. `frontiers`: as found for it.
  // Deterministic in the belief, and but for what frontiers are offered the same for all robots
  // that can reach each other. Of no use once query.stop says so. Cost: a search of
  // the grid for each robot.
  static std::optional<OwnArea> Find(const GoalQuery& query, const FrontierGoals& frontiers);

  // REQUIRES: reachable.
  const RobotId& OwnerOf(Cell cell) const { return sharers_[OwnerIndex(cell)].robot; }
  bool Has(Cell cell) const { return OwnerIndex(cell) == self_; }

 private:
  struct Sharer {
    RobotId robot;
    TravelFromStarts from_robot;
    double handicap_m = 0.0;
  };

  OwnArea(std::vector<Sharer> sharers, std::size_t self);
  std::size_t OwnerIndex(Cell cell) const;
  void Balance(const GoalQuery& query, const FrontierGoals& frontiers);

  std::vector<Sharer> sharers_;  // in the order of ids
  std::size_t self_;
};

}  // namespace plumescout
