// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "core/plan/strategy.h"
#include "core/types/ids.h"
#include "core/types/plan.h"
#include "core/types/stop.h"

namespace plumescout {

inline constexpr int kMostTeamRobots = 32;
inline constexpr int kMostTeamOrders = kMostTeamRobots + 2;

// A wish for plans for several robots at once.
struct TeamRequest {
  std::vector<RobotId> robots = {};  // empty: all that are free (team_belief.h)
  bool go_home = false;
  std::uint64_t seed = 0;  // 0: each plan's is derived from the mission's
  // Orders of the robots that are tried, at most their number + 2 of which are different. >= 1
  int max_order_count = 1;
  std::int64_t max_edge_evaluations = 0;  // of each search; 0: no bound
};

// What a combination of plans is worth: how many robots have something to do, and then the sum of
// their merits: what a way tells per second, or how soon it ends if that is not priced.
struct TeamValue {
  int busy = 0;
  double merit = 0.0;

  friend auto operator<=>(const TeamValue&, const TeamValue&) = default;
};
TeamValue ValueOf(const std::vector<Plan>& plans, const PlanningOptions& options);

// A robot of a team that got no plan.
struct LeftOut {
  RobotId robot;
  std::string why;  // what its plan to stay says, what its search failed with, or its commit

  friend bool operator==(const LeftOut&, const LeftOut&) = default;
};

struct TeamPlan {
  // One for each robot, in an order in which each keeps clear of those before it; to be committed
  // in this order.
  std::vector<Plan> plans;
  std::vector<LeftOut> left_out;  // whose search failed
  TeamValue value;
  int order_count = 0;   // that were tried to the end; 0: who is left out had no time
  int search_count = 0;  // plans that were searched for
};

// Plans for a team: robots choose one after the other, each knowing the plans of those before it as
// if they were live. First the one whose plan is best, of those left each time (lazily: a plan that
// was searched for before others chose is taken to promise the most that it can). Then other orders
// are tried, that one turned round and those in which another goes first, and the best is kept.
//
// By what their readings tell, robots that choose one after the other in any order have at least
// half of what the best combination of the ways on their lists tells, for that is submodular (see
// anticipation.h). They choose by value per second here, edges of the unseen included, as for
// single robots, and keep clear of each other: then there is no such bound, and the orders are what
// it is replaced by.
//
// A robot whose search fails is left out, with the error of Strategy::Plan; if it follows a plan
// the others reckon with that. Deterministic in belief, request and counts; `stop` ends the search
// with the best of the orders tried so far, and in the first order with those who have chosen and
// are clear of the plans and goals that the others keep.
//
// Errors: kInvalidArgument for more than kMostTeamRobots robots or one named twice, or an order
// count below 1; kNotFound for one that is named and not known; kFailedPrecondition TEAM_TOO_LARGE
// if none are named and more are free; kDeadlineExceeded DEADLINE_BEFORE_FIRST_PLAN if
// not even one such has, saying whose plan went for whose. Cost: for k
// robots some 2 k searches, at most k (k + 1) / 2, and k for each further order; those of the first
// order again for each time that robots which follow a plan are left out.
absl::StatusOr<TeamPlan> PlanTeam(const Strategy& strategy, const Belief& belief,
                                  const TeamRequest& request, const StopFn& stop);

}  // namespace plumescout
