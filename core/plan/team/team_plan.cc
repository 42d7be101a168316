// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/team/team_plan.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/plan/plan_seed.h"
#include "core/plan/plan_start.h"
#include "core/plan/selection/selection.h"
#include "core/plan/team/team_belief.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

constexpr double kLeast_s = 1e-3;  // a way takes this long at least

absl::Status CheckTeam(const std::vector<RobotId>& robots, const TeamRequest& request) {
  if (robots.size() > kMostTeamRobots) {
    return absl::InvalidArgumentError(
        absl::StrCat("robots = ", robots.size(), " must be at most ", kMostTeamRobots));
  }
  std::set<RobotId> names;
  for (const RobotId& robot : robots) {
    if (!names.insert(robot).second) {
      return absl::InvalidArgumentError(absl::StrCat("robots names \"", robot, "\" twice"));
    }
  }
  if (request.max_order_count < 1) {
    return absl::InvalidArgumentError(
        absl::StrCat("max_order_count = ", request.max_order_count, " must be >= 1"));
  }
  return absl::OkStatus();
}

// A plan that was searched for when so many others had chosen.
struct Draft {
  Plan plan;
  TeamValue value;
  std::size_t known = 0;
};

// Searches plans one after the other.
class TeamSearch {
 public:
  TeamSearch(const Strategy& strategy, const Belief& belief, const TeamRequest& request,
             const StopFn& stop)
      : strategy_(strategy), options_(belief.options->planning), request_(request), stop_(stop) {}

  int searches() const { return searches_; }

  absl::StatusOr<Draft> Search(const Belief& belief, const RobotId& robot, std::size_t known) {
    if (stop_()) return StoppedBeforeAnyPath();
    PlanRequest request;
    request.robot = robot;
    request.go_home = request_.go_home;
    request.seed = request_.seed == 0 ? 0 : DerivedPlanSeed(request_.seed, robot, 0);
    request.max_edge_evaluations = request_.max_edge_evaluations;
    ++searches_;
    PLUMESCOUT_ASSIGN_OR_RETURN(Plan plan, strategy_.Plan(belief, request, stop_));
    const TeamValue value = ValueOf({plan}, options_);
    return Draft{std::move(plan), value, known};
  }

  // The best goes first, lazily.
  absl::StatusOr<std::vector<Plan>> BestFirst(Belief belief, const std::vector<RobotId>& robots) {
    std::vector<Draft> left;
    for (const RobotId& robot : robots) {
      PLUMESCOUT_ASSIGN_OR_RETURN(Draft draft, Search(belief, robot, 0));
      left.push_back(std::move(draft));
    }
    std::vector<Plan> plans;
    while (!left.empty()) {
      const auto best =
          std::max_element(left.begin(), left.end(),
                           [](const Draft& a, const Draft& b) { return a.value < b.value; });
      if (best->known < plans.size()) {
        PLUMESCOUT_ASSIGN_OR_RETURN(*best, Search(belief, best->plan.robot, plans.size()));
        continue;
      }
      belief = WithPlan(belief, best->plan);
      plans.push_back(std::move(best->plan));
      left.erase(best);
    }
    return plans;
  }

  absl::StatusOr<std::vector<Plan>> InOrder(Belief belief, const std::vector<RobotId>& robots) {
    std::vector<Plan> plans;
    for (const RobotId& robot : robots) {
      PLUMESCOUT_ASSIGN_OR_RETURN(Draft draft, Search(belief, robot, plans.size()));
      belief = WithPlan(belief, draft.plan);
      plans.push_back(std::move(draft.plan));
    }
    return plans;
  }

 private:
  const Strategy& strategy_;
  const PlanningOptions& options_;
  const TeamRequest& request_;
  const StopFn& stop_;
  int searches_ = 0;
};

// The order turned round, and those in which another robot goes first. An order that was there
// before is not tried again.
std::vector<std::vector<RobotId>> OtherOrders(const std::vector<RobotId>& first) {
  std::vector<std::vector<RobotId>> orders = {first};
  const auto add = [&](std::vector<RobotId> order) {
    if (std::count(orders.begin(), orders.end(), order) == 0) orders.push_back(std::move(order));
  };
  add({first.rbegin(), first.rend()});
  for (std::size_t i = 1; i < first.size(); ++i) {
    std::vector<RobotId> order = first;
    std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(i),
                order.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    add(std::move(order));
  }
  orders.erase(orders.begin());
  return orders;
}

std::vector<RobotId> OrderOf(const std::vector<Plan>& plans) {
  std::vector<RobotId> order;
  for (const Plan& plan : plans) order.push_back(plan.robot);
  return order;
}

}  // namespace

TeamValue ValueOf(const std::vector<Plan>& plans, const PlanningOptions& options) {
  TeamValue value;
  for (const Plan& plan : plans) {
    if (plan.chosen < 0) continue;
    const Candidate& chosen = plan.candidates[static_cast<std::size_t>(plan.chosen)];
    const double duration_s = std::max(chosen.duration_s, kLeast_s);
    if (chosen.goal.kind != GoalKind::kMakeWay) ++value.busy;
    value.merit += chosen.expected_information_nats ? Worth_nats(chosen, options) / duration_s
                                                    : 1.0 / duration_s;
  }
  return value;
}

absl::StatusOr<TeamPlan> PlanTeam(const Strategy& strategy, const Belief& belief,
                                  const TeamRequest& request, const StopFn& stop) {
  const std::vector<RobotId> robots = request.robots.empty() ? FreeRobots(belief) : request.robots;
  PLUMESCOUT_RETURN_IF_ERROR(CheckTeam(robots, request));
  const PlanningOptions& options = belief.options->planning;
  const Belief start = WithoutPlans(belief, robots);
  TeamSearch search(strategy, belief, request, stop);
  TeamPlan team;
  PLUMESCOUT_ASSIGN_OR_RETURN(team.plans, search.BestFirst(start, robots));
  team.value = ValueOf(team.plans, options);
  team.order_count = 1;
  for (const std::vector<RobotId>& order : OtherOrders(OrderOf(team.plans))) {
    if (team.order_count >= request.max_order_count) break;
    auto plans = search.InOrder(start, order);
    if (absl::IsDeadlineExceeded(plans.status())) break;
    PLUMESCOUT_RETURN_IF_ERROR(plans.status());
    const TeamValue value = ValueOf(*plans, options);
    ++team.order_count;
    if (value > team.value) {
      team.value = value;
      team.plans = *std::move(plans);
    }
  }
  team.search_count = search.searches();
  return team;
}

}  // namespace plumescout
