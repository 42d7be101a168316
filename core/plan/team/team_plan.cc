// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/team/team_plan.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/plan/plan_seed.h"
#include "core/plan/plan_start.h"
#include "core/plan/selection/selection.h"
#include "core/plan/team/team_belief.h"
#include "core/traffic/traffic.h"
#include "core/types/checker.h"
#include "core/types/error_reason.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

constexpr double kLeast_s = 1e-3;  // a way takes this long at least

absl::StatusOr<std::vector<RobotId>> TeamOf(const Belief& belief, const TeamRequest& request) {
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker().AtLeast("max_order_count", request.max_order_count, 1).status());
  if (request.robots.empty()) {
    std::vector<RobotId> free = FreeRobots(belief);
    if (free.size() <= kMostTeamRobots) return free;
    return TypedError(absl::StatusCode::kFailedPrecondition, reason::kTeamTooLarge,
                      absl::StrCat(free.size(), " robots are free, a team has at most ",
                                   kMostTeamRobots, ": name those that are to be planned for"));
  }
  if (request.robots.size() > kMostTeamRobots) {
    return absl::InvalidArgumentError(
        absl::StrCat("robots = ", request.robots.size(), " must be at most ", kMostTeamRobots));
  }
  std::set<RobotId> names;
  for (const RobotId& robot : request.robots) {
    if (!names.insert(robot).second) {
      return absl::InvalidArgumentError(absl::StrCat("robots names \"", robot, "\" twice"));
    }
    if (!belief.robots.contains(robot)) {
      return absl::NotFoundError(absl::StrCat("robot \"", robot, "\" is not registered"));
    }
  }
  return request.robots;
}

// A plan that was searched for when so many others had chosen.
struct Draft {
  Plan plan;
  TeamValue value;
  std::size_t known = 0;
};

// Plans of the order in which the best goes first, and whose search failed.
struct FirstOrder {
  std::vector<Plan> plans;
  std::vector<LeftOut> left_out;
  absl::Status stopped = absl::OkStatus();

  void LeaveOut(const RobotId& robot, const absl::Status& status) {
    left_out.push_back({robot, std::string(status.message())});
    if (absl::IsDeadlineExceeded(status)) stopped = status;
  }
};

// Searches plans one after the other.
class TeamSearch {
 public:
  TeamSearch(const Strategy& strategy, const Belief& belief, const TeamRequest& request,
             const StopFn& stop)
      : strategy_(strategy),
        options_(InField(belief.options->planning, belief.options->gas)),
        request_(request),
        stop_(stop) {}

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
  FirstOrder BestFirst(Belief belief, const std::vector<RobotId>& robots) {
    FirstOrder order;
    std::vector<Draft> left;
    for (const RobotId& robot : robots) {
      absl::StatusOr<Draft> draft = Search(belief, robot, 0);
      if (draft.ok()) left.push_back(*std::move(draft));
      if (!draft.ok()) order.LeaveOut(robot, draft.status());
    }
    std::vector<Plan>& plans = order.plans;
    while (!left.empty()) {
      const auto best =
          std::max_element(left.begin(), left.end(),
                           [](const Draft& a, const Draft& b) { return a.value < b.value; });
      if (best->known < plans.size()) {
        absl::StatusOr<Draft> draft = Search(belief, best->plan.robot, plans.size());
        if (draft.ok()) {
          *best = *std::move(draft);
        } else {
          order.LeaveOut(best->plan.robot, draft.status());
          left.erase(best);
        }
        continue;
      }
      belief = WithPlan(belief, best->plan);
      plans.push_back(std::move(best->plan));
      left.erase(best);
    }
    return order;
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
  const PlanningOptions options_;
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

// Who gets no plan keeps the one that it has, and others have to reckon with that. Returns whether
// there is such a robot.
bool TakeOut(const std::vector<LeftOut>& left_out, const Belief& belief,
             std::vector<RobotId>& robots) {
  bool keeps_plan = false;
  for (const LeftOut& one : left_out) {
    if (std::erase(robots, one.robot) == 0) continue;
    keeps_plan = keeps_plan || belief.robots.at(one.robot).live_trajectory != nullptr;
  }
  return keeps_plan;
}

std::vector<RobotId> OrderOf(const std::vector<Plan>& plans) {
  std::vector<RobotId> order;
  for (const Plan& plan : plans) order.push_back(plan.robot);
  return order;
}

// Whether the plan, made as if the robot had none, runs into its live plan or takes its goal.
bool IsAgainst(const RobotRecord& record, const Plan& plan, const Belief& belief) {
  if (plan.chosen < 0 || record.live_trajectory == nullptr) return false;
  const PlanningOptions& options = belief.options->planning;
  const RobotId& robot = record.state.id;
  const std::map<RobotId, RobotRecord> both = {{plan.robot, belief.robots.at(plan.robot)},
                                               {robot, record}};
  const bool meets = options.yield_to_robots &&
                     Traffic(both, plan.robot, options.robot_clearance_m, belief.sample_time_ns)
                         .FirstMeeting(plan.trajectory);
  const Goal& goal = plan.candidates[static_cast<std::size_t>(plan.chosen)].goal;
  const bool claims = goal.kind != GoalKind::kHome && goal.kind != GoalKind::kMakeWay;
  return meets ||
         (claims &&
          std::any_of(belief.claims.begin(), belief.claims.end(), [&](const GoalClaim& claim) {
            return claim.robot == robot && IsSameErrand(claim.goal, goal);
          }));
}

// Of an order that there was no time to repeat those plans that can be driven beside the plans of
// who is left out; whose plan goes is left out too.
void KeepClearOfLeftOut(const Belief& belief, FirstOrder& order) {
  for (std::size_t i = 0; i < order.left_out.size(); ++i) {
    const auto known = belief.robots.find(order.left_out[i].robot);
    if (known == belief.robots.end()) continue;
    for (auto plan = order.plans.begin(); plan != order.plans.end();) {
      if (IsAgainst(known->second, *plan, belief)) {
        order.left_out.push_back({plan->robot, absl::StrCat("its plan is against that of robot \"",
                                                            known->first, "\", which keeps it")});
        plan = order.plans.erase(plan);
      } else {
        ++plan;
      }
    }
  }
}

// The first order, again without those who keep their plans, or what of it stands if time is up.
// `robots` is then without them.
FirstOrder FindFirstOrder(const Belief& belief, TeamSearch& search, std::vector<RobotId>& robots) {
  FirstOrder order = search.BestFirst(WithoutPlans(belief, robots), robots);
  while (order.stopped.ok() && TakeOut(order.left_out, belief, robots)) {
    FirstOrder again = search.BestFirst(WithoutPlans(belief, robots), robots);
    if (again.stopped.ok()) {
      again.left_out.insert(again.left_out.begin(), order.left_out.begin(), order.left_out.end());
      order = std::move(again);
    } else {
      order.stopped = again.stopped;
    }
  }
  if (!order.stopped.ok()) KeepClearOfLeftOut(belief, order);
  return order;
}

// Why nobody has a plan for want of time: what became of each robot that got one.
absl::Status NobodyInTime(const FirstOrder& order) {
  std::string message = "planning was stopped before any robot had a plan";
  for (const LeftOut& one : order.left_out) {
    if (one.why == order.stopped.message()) continue;
    absl::StrAppend(&message, "; robot \"", one.robot, "\": ", one.why);
  }
  return TypedError(absl::StatusCode::kDeadlineExceeded, reason::kDeadlineBeforeFirstPlan, message);
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
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<RobotId> robots, TeamOf(belief, request));
  const PlanningOptions options = InField(belief.options->planning, belief.options->gas);
  TeamSearch search(strategy, belief, request, stop);
  TeamPlan team;
  FirstOrder first = FindFirstOrder(belief, search, robots);
  if (first.plans.empty() && !first.stopped.ok()) return NobodyInTime(first);
  team.plans = std::move(first.plans);
  team.left_out = std::move(first.left_out);
  team.value = ValueOf(team.plans, options);
  team.order_count = first.stopped.ok() ? 1 : 0;
  const Belief start = WithoutPlans(belief, robots);
  for (const std::vector<RobotId>& order : OtherOrders(OrderOf(team.plans))) {
    if (team.order_count == 0 || team.order_count >= request.max_order_count) break;
    auto plans = search.InOrder(start, order);
    if (absl::IsDeadlineExceeded(plans.status())) break;
    if (!plans.ok()) continue;
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
