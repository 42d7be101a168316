// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/team_rival.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/grid/grid_search.h"
#include "core/plan/departure.h"
#include "core/plan/right_of_way.h"
#include "core/plan/wait_place.h"
#include "core/types/status_macros.h"
#include "lab/rivals/team_rules.h"

namespace plumescout::lab {
namespace {

constexpr double kNoWay_m = std::numeric_limits<double>::infinity();

// Where other robots are driving to.
std::vector<Goal> TakenGoals(const Belief& belief, const RobotId& robot) {
  std::vector<Goal> taken;
  for (const GoalClaim& claim : belief.claims) {
    const bool holds = claim.robot != robot && claim.expires_ns > belief.sample_time_ns;
    if (holds) taken.push_back(claim.goal);
  }
  return taken;
}

std::vector<Point2> CentroidsOf(const std::vector<Goal>& goals) {
  std::vector<Point2> centroids;
  for (const Goal& goal : goals) centroids.push_back(goal.centroid);
  return centroids;
}

std::vector<Point2> PositionsOf(const std::vector<Goal>& goals) {
  std::vector<Point2> positions;
  for (const Goal& goal : goals) positions.push_back(goal.position);
  return positions;
}

// From a robot's place to each of the goals.
std::vector<double> Travel_m(const Belief& belief, Point2 place, const std::vector<Goal>& goals) {
  std::vector<double> ways_m(goals.size(), kNoWay_m);
  if (!belief.occupancy->Contains(belief.geometry().CellAt(place))) return ways_m;
  const std::optional<Departure> departure = Depart(belief, place);
  if (!departure) return ways_m;
  const Grid<double> travel_m = TravelDistances_m(
      *belief.traversable, std::vector<Cell>{belief.geometry().CellAt(departure->start)});
  for (std::size_t i = 0; i < goals.size(); ++i) ways_m[i] = travel_m.At(goals[i].cell, kNoWay_m);
  return ways_m;
}

std::size_t GreatestOf(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

class TeamRival final : public Strategy {
 public:
  TeamRival(TeamRule rule, const PlanningOptions& options,
            std::unique_ptr<const Strategy> frontiers)
      : rule_(rule), options_(options), frontiers_(std::move(frontiers)) {}

  absl::StatusOr<plumescout::Plan> Plan(const Belief& belief, const PlanRequest& request,
                                        const StopFn& stop,
                                        const PlanListener& improved) const override {
    PLUMESCOUT_ASSIGN_OR_RETURN(plumescout::Plan plan,
                                frontiers_->Plan(belief, request, stop, improved));
    const bool explores = plan.chosen >= 0 && plan.phase == MissionPhase::kExploring;
    if (!explores) return plan;
    PLUMESCOUT_ASSIGN_OR_RETURN(
        const Pose2 start, StartPose(belief, request, belief.robots.at(request.robot), options_));
    plan.chosen = static_cast<int>(ChooseFor(belief, start.position(), plan));
    const Candidate& chosen = plan.candidates[static_cast<std::size_t>(plan.chosen)];
    plan.trajectory = TrajectoryOf(chosen, start.yaw_rad, options_);
    WaitOutOfTheWay(belief, options_, plan);
    plan.explanation = absl::StrCat("A frontier chosen by the rule \"", NameOf(rule_), "\" among ",
                                    plan.candidates.size(), ".");
    return plan;
  }

 private:
  std::size_t ChooseFor(const Belief& belief, Point2 start, const plumescout::Plan& plan) const {
    std::vector<Goal> goals;
    for (const Candidate& candidate : plan.candidates) goals.push_back(candidate.goal);
    const std::vector<Goal> taken = TakenGoals(belief, plan.robot);
    switch (rule_) {
      case TeamRule::kBurgard:
        break;
      case TeamRule::kMatching:
        return Match(belief, start, std::move(goals), plan);
      case TeamRule::kRrtExploration:
        return GreatestOf(
            RrtRevenues(start, CentroidsOf(goals), CentroidsOf(taken), *belief.occupancy, {}));
    }
    return GreatestOf(BurgardValues(PositionsOf(goals), Travel_m(belief, start, goals),
                                    PositionsOf(taken), *belief.occupancy, {}));
  }

  // Everybody is matched, from where they are now, with what is left of all frontiers: those too
  // that others drive to, or whose ways others are in for now, where this robot cannot go.
  std::size_t Match(const Belief& belief, Point2 start, std::vector<Goal> goals,
                    const plumescout::Plan& plan) const {
    const std::size_t own = goals.size();
    for (const RejectedGoal& rejected : plan.rejected) {
      const bool is_for_others = rejected.reason == RejectionReason::kClaimed ||
                                 rejected.reason == RejectionReason::kTraffic;
      if (is_for_others) goals.push_back(rejected.goal);
    }
    std::vector<std::vector<double>> travel_m = {Travel_m(belief, start, goals)};
    std::fill(travel_m[0].begin() + static_cast<std::ptrdiff_t>(own), travel_m[0].end(), kNoWay_m);
    const std::vector<double> ways_m = travel_m[0];
    for (const auto& [id, record] : belief.robots) {
      if (id == plan.robot || !record.state.has_pose || record.state.silent) continue;
      travel_m.push_back(Travel_m(belief, record.state.pose.position(), goals));
    }
    const std::size_t matched = MatchGoals(std::move(travel_m)).front();
    if (matched < own) return matched;
    // None but others' are left for it: the nearest that it can go to.
    return static_cast<std::size_t>(std::min_element(ways_m.begin(), ways_m.end()) -
                                    ways_m.begin());
  }

  TeamRule rule_;
  PlanningOptions options_;
  std::unique_ptr<const Strategy> frontiers_;
};

}  // namespace

std::string NameOf(TeamRule rule) {
  switch (rule) {
    case TeamRule::kBurgard:
      break;
    case TeamRule::kMatching:
      return "matching";
    case TeamRule::kRrtExploration:
      return "rrt_exploration";
  }
  return "burgard";
}

std::unique_ptr<const Strategy> MakeTeamRival(TeamRule rule, const PlanningOptions& options,
                                              std::unique_ptr<const Strategy> frontiers) {
  return std::make_unique<const TeamRival>(rule, options, std::move(frontiers));
}

}  // namespace plumescout::lab
