// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/belief/belief.h"
#include "core/gas/gas_what_if.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "core/types/stop.h"

namespace plumescout {

// Readings that the other robots of a mission are about to take on what is left of their live
// plans, as cells of the belief's map. A promise far ahead, or of a robot that has fallen behind
// its plan, has less precision: the full one for 10 s, then e times less every 20 s. Who is silent,
// has strayed or is long overdue promises nothing. At most kMostPromised, and fewer on a map of
// more than 100,000 cells, where each costs more: neighbours on one way are put together in the
// middle of them, with the sum of their precisions. Cost: O(readings).
inline constexpr std::size_t kMostPromised = 64;
std::vector<ForeseenCell> PromisedReadings(const Belief& belief, const RobotId& robot,
                                           const PlanningOptions& options);

// The belief with its gas field as sure as it is to be once those readings have been taken: what a
// way of the robot's own tells is then what it tells besides, I(own and others) - I(others), and
// what others will have observed is no goal. Chosen one after the other like this, the ways of k
// robots tell at least half of the most that ways from the same lists of candidates could, for the
// sum of relevance * 1/2 ln(variance) is monotone and submodular: H is an M-matrix, so that to know
// more never raises a correlation. Not so once value is divided by time, as our choice does, or the
// unseen is counted beside it: a way is paid for the edge that it ends at, and not for those that
// it passes.
// Means, and all else, are those of now. None if nothing is promised, or there is no gas
// field, or once `stop`, which is asked all along, says so. Cost: that of GasWhatIf::Given, and
// O(cells).
std::optional<Belief> Anticipate(const Belief& belief, const RobotId& robot,
                                 const PlanningOptions& options, const StopFn& stop = {});

// What the other robots of a mission are to see on what is left of their live plans, of the same
// robots as readings are promised by. A look ahead is trusted as a reading at that time would be.
// Who passes an edge of the unseen sees what hides behind it, who looks at it from afar only that
// it is there, so a look shows a share of it that falls with the distance, to nothing at the range.
class PromisedSight {
 public:
  static constexpr double kRange_m = 8.0;  // most lidars see as far indoors

  // Holds a reference to the belief. Cost: O(waypoints) for each half second ahead of each robot.
  PromisedSight(const Belief& belief, const RobotId& robot, double range_m = kRange_m);

  // Of what hides behind an edge of the unseen at this place, [0, 1]: by the one look that shows
  // the most. Cells that are occupied are not looked through. Cost: O(looks), and a walk along the
  // line of sight for those that show more than the ones before.
  double ShareOf(Point2 place) const;

 private:
  struct Look {
    Point2 from;
    double trust = 0.0;
  };

  const Belief& belief_;
  double range_m_;
  std::vector<Look> looks_;
};

// Leaves to others what they are to see: candidates that end at an edge of the unseen keep of its
// worth what is theirs (Candidate::unseen_share). Cost: that of PromisedSight.
void LeavePromisedSight(const Belief& belief, Plan& plan);

}  // namespace plumescout
