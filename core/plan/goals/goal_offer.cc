// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/goal_offer.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/plan/goals/frontier_goals.h"
#include "core/plan/goals/goal_policy.h"
#include "core/plan/goals/home_goal.h"
#include "core/plan/goals/information_goals.h"
#include "core/plan/goals/own_area.h"
#include "core/plan/goals/random_goals.h"

namespace plumescout {

TravelFromStarts TravelFrom(const GoalQuery& query, std::vector<SearchSource> sources) {
  CellRect cells = CellsAroundFree(*query.belief.occupancy);
  cells.Include(query.start);
  TravelFromStarts travel(
      query.reachable.geometry(), cells, Connectivity::kEightNoCornerCut,
      [&query](std::size_t index) { return query.reachable[index] != 0; }, query.stop);
  travel.Run(std::move(sources), [&query] { return Stops(query.stop); });
  return travel;
}

const TravelFromStarts& GoalQuery::FromStart() const {
  if (!from_start) from_start.emplace(TravelFrom(*this, {{start}}));
  return *from_start;
}

const TravelFromStarts& GoalQuery::FromHome() const {
  if (!from_home) {
    const HomeGoal home = FindHome(*this);
    std::vector<SearchSource> sources;
    if (home.reachable) sources.push_back({home.goal.cell});
    from_home.emplace(TravelFrom(*this, std::move(sources)));
  }
  return *from_home;
}

GoalOffer GoHome(const GoalQuery& query) {
  GoalOffer result;
  const HomeGoal home = FindHome(query);
  if (!home.reachable) {
    result.rejected.push_back({home.goal, RejectionReason::kUnreachable, "no traversable way"});
  } else if (!home.is_there) {
    result.goals.push_back(home.goal);
  }
  return result;
}

namespace {

// Nothing but the way home, if robots end there.
GoalOffer EndMission(const GoalQuery& query, bool at_home, GoalOffer result) {
  if (at_home) {
    GoalOffer way_home = GoHome(query);
    result.goals = std::move(way_home.goals);
    std::move(way_home.rejected.begin(), way_home.rejected.end(),
              std::back_inserter(result.rejected));
  }
  result.complete = result.goals.empty();
  return result;
}

// Takes those out that lie in other robots' areas.
void LeaveToOthers(const OwnArea& area, std::vector<OfferedGoal>& goals,
                   std::vector<RejectedGoal>& rejected) {
  std::erase_if(goals, [&](const OfferedGoal& offered) {
    if (area.Has(offered.goal.cell)) return false;
    rejected.push_back(
        {offered.goal, RejectionReason::kClaimed,
         absl::StrCat("in the area of robot \"", area.OwnerOf(offered.goal.cell), "\"")});
    return true;
  });
}

// Goals that are there for what there is to learn, in the robot's own area or anywhere.
GoalOffer FindWork(const GoalQuery& query, FrontierGoals frontiers, bool own_area_alone, Rng& rng) {
  std::optional<OwnArea> area;
  if (own_area_alone && !Stops(query.stop)) area = OwnArea::Find(query, frontiers);
  if (area) {
    LeaveToOthers(*area, frontiers.gas, frontiers.rejected);
    LeaveToOthers(*area, frontiers.occupancy, frontiers.rejected);
  }
  GoalOffer result;
  result.rejected = std::move(frontiers.rejected);
  result.goals = ChooseByPolicy(std::move(frontiers), query.options, rng, result.rejected);
  if (query.options.goal_policy == GoalPolicy::kEverything && !Stops(query.stop)) {
    const std::vector<Goal> telling =
        InformationGoals(query, result.rejected, area ? &*area : nullptr);
    result.goals.insert(result.goals.end(), telling.begin(), telling.end());
  }
  return result;
}

}  // namespace

GoalOffer FindGoals(const GoalQuery& query, Rng& rng) {
  if (query.go_home) return GoHome(query);
  if (IsOver(query.belief)) {
    return EndMission(query, query.options.return_home || query.belief.deadline_ns, {});
  }
  const bool shares = query.options.balanced_areas && query.belief.robots.size() > 1;
  FrontierGoals frontiers = FindFrontierGoals(query);
  GoalOffer result;
  if (shares) result = FindWork(query, frontiers, true, rng);
  if (!shares || (result.goals.empty() && !Stops(query.stop))) {
    result = FindWork(query, std::move(frontiers), false, rng);
  }
  if (!result.goals.empty() || Stops(query.stop)) return result;

  result.fallback = true;
  // Without a gas sensor all would stay unobserved, and the mission would never end.
  if (query.options.fallback_to_unobserved && query.belief.gas_counters.readings > 0) {
    result.goals = UnobservedGoals(query, rng);
  }
  if (!result.goals.empty()) return result;

  const bool others_are_exploring = std::any_of(
      result.rejected.begin(), result.rejected.end(),
      [](const RejectedGoal& goal) { return goal.reason == RejectionReason::kClaimed; });
  if (query.robot.fruitless_fallbacks >= query.options.fallback_limit && !others_are_exploring) {
    result.fallback = false;
    return EndMission(query, query.options.return_home, std::move(result));
  }
  result.goals = RandomGoals(query, rng);
  return result;
}

}  // namespace plumescout
