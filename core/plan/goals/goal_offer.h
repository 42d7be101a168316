// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/belief/belief.h"
#include "core/frontier/goal_cells.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/rng.h"
#include "core/types/stop.h"

namespace plumescout {

// For whom goals are sought. Holds references: for the length of one call.
struct GoalQuery {
  const Belief& belief;
  const RobotRecord& robot;
  Cell start;                           // traversable
  const Grid<std::uint8_t>& reachable;  // 1: traversable and connected to `start`
  const PlanningOptions& options;
  bool go_home = false;  // home is the only goal
  // As the belief is to be once other robots have driven their ways; null if they drive none. What
  // they will have observed by then is no goal.
  const Belief* ahead = nullptr;
  // Once it says so, what is found from then on is of no use.
  StopFn stop = {};

  // The ways from `start` by steps between reachable cells. Cost: O(cells) when first asked.
  const TravelFromStarts& FromStart() const;
  mutable std::optional<TravelFromStarts> from_start = std::nullopt;
  // The same from home; from nowhere if that cannot be reached.
  const TravelFromStarts& FromHome() const;
  mutable std::optional<TravelFromStarts> from_home = std::nullopt;
};

// The ways from there by steps between reachable cells. Cost: O(cells).
TravelFromStarts TravelFrom(const GoalQuery& query, std::vector<SearchSource> sources);

struct GoalOffer {
  std::vector<Goal> goals;
  std::vector<RejectedGoal> rejected;
  bool fallback = false;  // nothing else was left: `goals` are drawn at random
  bool complete = false;  // nothing is left to do: `goals` is empty
};

// Nothing to drive to if the robot is home already, and a rejection if there is no way.
GoalOffer GoHome(const GoalQuery& query);

// Where to go, by options.goal_policy (section VI-B of [XIT]); under kEverything also where
// readings tell much (see InformationGoals). If nothing can be offered, places with unobserved gas
// are (ours, options.fallback_to_unobserved; not before the first gas reading), then random free
// ones (section VII); once options.fallback_limit random places in a row were reached and revealed
// nothing, the mission is complete instead. A goal that another robot is on its way to keeps the
// mission open, for what that robot finds may need this one; one that is set aside does not, or a
// frontier that no visit can dissolve would keep robots driving for ever. With options.return_home
// the robot goes home before its mission is complete. With options.balanced_areas goals in other
// robots' areas (own_area.h) are theirs, kClaimed, as long as there are any in its own. If
// query.go_home, this is GoHome. Once the mission is over (IsOver) it is complete at once, or as
// soon as the robot is home. Deterministic in the query and `rng`, unless query.stop says so, which
// is asked all along. Cost: O(cells).
GoalOffer FindGoals(const GoalQuery& query, Rng& rng);

}  // namespace plumescout
