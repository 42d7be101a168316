// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/team_plans.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/plan/selection/selection.h"
#include "core/plan/strategy.h"
#include "core/plan/team/team_belief.h"
#include "core/plan/team/team_plan.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/about/cpu_time.h"
#include "lab/worlds/mid_mission.h"

namespace plumescout::lab {
namespace {

// A way of planning for a team, over all moments.
struct Row {
  std::vector<double> cpu_ms;
  std::vector<double> merit_ratio;  // over that of robots in the order of their names
  int busy_more = 0;                // moments at which more robots have something to do than so
  int busy_fewer = 0;
  double searches = 0.0;
};

std::vector<RobotId> RobotsOf(const Belief& belief) {
  std::vector<RobotId> robots;
  for (const auto& [robot, record] : belief.robots) robots.push_back(robot);
  return robots;
}

// One after the other, as robots that ask in this order.
absl::StatusOr<TeamValue> InOrderOfNames(const Strategy& strategy, const Belief& belief) {
  const std::vector<RobotId> robots = RobotsOf(belief);
  Belief known = WithoutPlans(belief, robots);
  std::vector<Plan> plans;
  for (const RobotId& robot : robots) {
    PlanRequest request;
    request.robot = robot;
    PLUMESCOUT_ASSIGN_OR_RETURN(Plan plan, strategy.Plan(known, request, NeverStop()));
    known = WithPlan(known, plan);
    plans.push_back(std::move(plan));
  }
  return ValueOf(plans, InField(belief.options->planning, belief.options->gas));
}

absl::Status PlanFor(const Strategy& strategy, const Belief& belief, int orders,
                     const TeamValue& beside, Row& row) {
  TeamRequest request;
  request.robots = RobotsOf(belief);
  request.max_order_count = orders;
  const double begin_ms = ThreadCpu_ms();
  PLUMESCOUT_ASSIGN_OR_RETURN(const TeamPlan team,
                              PlanTeam(strategy, belief, request, NeverStop()));
  row.cpu_ms.push_back(ThreadCpu_ms() - begin_ms);
  row.searches += team.search_count;
  row.busy_more += team.value.busy > beside.busy ? 1 : 0;
  row.busy_fewer += team.value.busy < beside.busy ? 1 : 0;
  if (beside.merit > 0.0) row.merit_ratio.push_back(team.value.merit / beside.merit);
  return absl::OkStatus();
}

void Tell(const Row& row, const std::string& name, BenchSummary& summary) {
  const auto moments = static_cast<double>(row.cpu_ms.size());
  summary.Set(name + "_ms", Median(row.cpu_ms));
  summary.Set(name + "_searches", row.searches / moments);
  summary.Set(name + "_merit_ratio", Median(row.merit_ratio));
  summary.Set(name + "_merit_ratio_p10", Quantile(row.merit_ratio, 0.1));
  summary.Set(name + "_busy_more_share", row.busy_more / moments);
  summary.Set(name + "_busy_fewer_share", row.busy_fewer / moments);
}

struct TeamCase {
  std::string name;
  int width_cells = 0;
  int height_cells = 0;
  int robots = 0;
};

absl::Status MeasureTeam(const TeamCase& team, BenchSummary& summary) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto strategy, MakeStrategy(PlanningOptions()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<PlanMoment> moments,
                              RunToMidMission({.width_cells = team.width_cells,
                                               .height_cells = team.height_cells,
                                               .robots = team.robots,
                                               .seed = summary.seed()}));
  const std::vector<int> orders = {1, 3, team.robots + 2};
  std::vector<Row> rows(orders.size());
  std::vector<double> in_order_ms;
  // Once in each round.
  for (std::size_t i = 0; i < moments.size(); i += static_cast<std::size_t>(team.robots)) {
    const Belief& belief = *moments[i].belief;
    const double begin_ms = ThreadCpu_ms();
    PLUMESCOUT_ASSIGN_OR_RETURN(const TeamValue beside, InOrderOfNames(*strategy, belief));
    in_order_ms.push_back(ThreadCpu_ms() - begin_ms);
    for (std::size_t k = 0; k < orders.size(); ++k) {
      PLUMESCOUT_RETURN_IF_ERROR(PlanFor(*strategy, belief, orders[k], beside, rows[k]));
    }
  }
  summary.Set(absl::StrCat("team_", team.name, "_by_name_ms"), Median(in_order_ms));
  for (std::size_t k = 0; k < orders.size(); ++k) {
    Tell(rows[k], absl::StrCat("team_", team.name, "_orders_", orders[k]), summary);
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status MeasureTeams(BenchSummary& summary) {
  for (const TeamCase& team :
       {TeamCase{"16x20m_4_robots", 160, 200, 4}, TeamCase{"16x20m_8_robots", 160, 200, 8},
        TeamCase{"32x40m_4_robots", 320, 400, 4}, TeamCase{"32x40m_8_robots", 320, 400, 8}}) {
    PLUMESCOUT_RETURN_IF_ERROR(MeasureTeam(team, summary));
  }
  return absl::OkStatus();
}

}  // namespace plumescout::lab
